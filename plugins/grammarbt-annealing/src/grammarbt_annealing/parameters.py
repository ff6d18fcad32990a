"""The parameters of the searcher, with their help texts."""

from __future__ import annotations

from typing import Literal, TypeAlias

from attrs import field, frozen, validators

Cooling: TypeAlias = Literal["linear", "geometric"]


@frozen(kw_only=True)
class AnnealingParameters:
    """How it cools, and how long it goes on without gain."""

    cooling: Cooling = field(
        default="linear",
        validator=validators.in_(("linear", "geometric")),
        metadata={"help": "how the temperature comes down over the budget"},
    )
    hottest: float = field(
        default=0.3,
        validator=validators.gt(0.0),
        metadata={"help": "first temperature, in standard deviations of the returns"},
    )
    coldest: float = field(
        default=0.003, validator=validators.gt(0.0), metadata={"help": "last temperature, in the same unit"}
    )
    first_trees: int = field(
        default=20, validator=validators.ge(2), metadata={"help": "random trees of which the best is the first"}
    )
    episodes: int = field(
        default=4,
        validator=validators.ge(1),
        metadata={"help": "common scenarios on which a neighbour is compared; 1 where all scenarios are alike"},
    )
    reset_after: int = field(
        default=100,
        validator=validators.ge(1),
        metadata={"help": "steps without gain after which it goes on from the best tree"},
    )
    trim: bool = field(default=True, metadata={"help": "take away elements of lists of which no leaf was ever ticked"})
