"""The parameters of the searcher, with their help texts."""

from __future__ import annotations

from attrs import field, frozen, validators

from grammarbt.search import EvolutionParameters


@frozen(kw_only=True)
class GpParameters(EvolutionParameters):
    """How derivation trees are bred."""

    crossover: float = field(
        default=0.4,
        validator=[validators.ge(0.0), validators.le(1.0)],
        metadata={"help": "probability that a child gets a sub-tree of another parent, instead of a mutation"},
    )
    greedy: float = field(
        default=0.1,
        validator=[validators.ge(0.0), validators.lt(1.0)],
        metadata={"help": "share of the budget that tries the smallest trees first; 0 begins with random trees"},
    )
    trim: bool = field(
        default=True,
        metadata={"help": "take away elements of lists of which no leaf was ever ticked, before a tree is bred from"},
    )
