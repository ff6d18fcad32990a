"""The parameters of the searcher, with their help texts."""

from __future__ import annotations

from attrs import field, frozen, validators

from grammarbt.search import EvolutionParameters
from grammarbt_ge.initialise import InitialiseName
from grammarbt_ge.mapping import MappingName

MOST = 150
"""Individuals in a generation, unless the user asks for more: populations begin anew, so that there may be several."""

_share = [validators.ge(0.0), validators.le(1.0)]


@frozen(kw_only=True)
class GeParameters(EvolutionParameters):
    """How genomes are read and bred."""

    population: int | None = field(
        default=None,
        validator=validators.optional(validators.ge(2)),
        metadata={"help": f"individuals in a generation; unset: a fortieth of the budget, from 50 to {MOST}"},
    )
    tournament: int = field(
        default=5,
        validator=validators.ge(1),
        metadata={"help": "individuals of which the best becomes a parent"},
    )
    distinct: bool = field(
        default=True,
        metadata={"help": "of individuals with equal means only one lives on or breeds, so that no plateau takes over"},
    )
    patience: int = field(
        default=20,
        validator=validators.ge(0),
        metadata={"help": "generations without a better best after which a new population begins; 0: never"},
    )
    mapping: MappingName = field(
        default="linear",
        validator=validators.in_(("linear", "structured")),
        metadata={"help": "linear: one list of codons; structured: one list per nonterminal"},
    )
    wraps: int = field(
        default=2,
        validator=validators.ge(0),
        metadata={"help": "how often a list of codons is read again from its beginning"},
    )
    initialise: InitialiseName = field(
        default="pi-grow",
        validator=validators.in_(("pi-grow", "sensible", "random")),
        metadata={"help": "how the first generation is made"},
    )
    depth: int = field(
        default=7,
        validator=validators.ge(1),
        metadata={"help": "how much deeper than the lowest derivation tree the first generation grows"},
    )
    crossover: float = field(
        default=0.4,
        validator=_share,
        metadata={"help": "probability that a child has two parents"},
    )
    matching: float = field(
        default=1.0,
        validator=_share,
        metadata={"help": "share of them that exchange sub-trees of the same nonterminal, instead of heads and tails"},
    )
    regrow: float = field(
        default=0.7,
        validator=_share,
        metadata={"help": "share of the other children that get a random sub-tree, instead of one codon drawn anew"},
    )

    def size(self, budget: int) -> int:
        """Individuals in a generation."""
        return self.population or min(super().size(budget), MOST)
