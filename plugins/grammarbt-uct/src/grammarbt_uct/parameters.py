"""The parameters of the searcher, with their help texts."""

from __future__ import annotations

from attrs import field, frozen, validators

from grammarbt.search import BanditName


@frozen(kw_only=True)
class UctParameters:
    """How children are selected."""

    bandit: BanditName = field(
        default="ucb1",
        validator=validators.in_(("ucb1", "ucb1-tuned", "ucb1-normal2", "ucb1-uniform", "threshold-ascent")),
        metadata={"help": "rule that selects among the children of a node"},
    )
    c: float = field(
        default=0.5, validator=validators.ge(0.0), metadata={"help": "exploration constant, in ranges of the returns"}
    )
