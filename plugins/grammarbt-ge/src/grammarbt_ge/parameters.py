"""The parameters of the searcher, with their help texts."""

from __future__ import annotations

from attrs import field, frozen, validators

from grammarbt.search import EvolutionParameters
from grammarbt_ge.initialise import InitialiseName
from grammarbt_ge.mapping import MappingName


@frozen(kw_only=True)
class GeParameters(EvolutionParameters):
    """How genomes are read and bred."""

    tournament: int = field(
        default=12,
        validator=validators.ge(1),
        metadata={"help": "individuals of which the best becomes a parent"},
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
        default=0.9,
        validator=[validators.ge(0.0), validators.le(1.0)],
        metadata={"help": "probability that a child has two parents"},
    )
    flip: float = field(
        default=0.05,
        validator=[validators.ge(0.0), validators.le(1.0)],
        metadata={"help": "probability that a codon is drawn anew"},
    )
