"""The parameters of the searcher, with their help texts."""

from __future__ import annotations

from typing import Literal, TypeAlias

from attrs import field, frozen, validators

Table: TypeAlias = Literal["productions", "policy"]
View: TypeAlias = Literal["place", "progress", "state"]

_share = [validators.ge(0.0), validators.le(1.0)]


@frozen(kw_only=True)
class QLearningParameters:
    """How values are learned, and how much is left to chance."""

    table: Table = field(
        default="productions",
        validator=validators.in_(("productions", "policy")),
        metadata={
            "help": "what has values: productions: those of the grammar; policy: actions in each truth assignment of the "
            "conditions, of which there may be few"
        },
    )
    view: View = field(
        default="progress",
        validator=validators.in_(("place", "progress", "state")),
        metadata={
            "help": "table=productions: what a state is: place: parent, place among its children, and how many options there are; "
            "progress: depth, and what the open scopes have used; state: all that makes productions legal"
        },
    )
    trace: float = field(
        default=1.0,
        validator=_share,
        metadata={
            "help": "table=productions: lambda: 1 learns from returns alone (Monte Carlo), 0 from the next value (bootstrapped)"
        },
    )
    rate: float = field(
        default=0.3,
        validator=[validators.gt(0.0), validators.le(1.0)],
        metadata={"help": "smallest step towards a new target; the n-th visit takes 1/n while that is larger"},
    )
    first_chance: float = field(
        default=1.0, validator=_share, metadata={"help": "epsilon in the beginning: probability of a random choice"}
    )
    last_chance: float = field(default=0.02, validator=_share, metadata={"help": "epsilon in the end"})
    cooled: float = field(
        default=0.6,
        validator=[validators.gt(0.0), validators.le(1.0)],
        metadata={"help": "share of the budget after which epsilon has come down"},
    )
    imitation: float = field(
        default=0.5,
        validator=_share,
        metadata={
            "help": "table=productions: share of the derivations that repeat the best tree, but for one decision"
        },
    )

    def chance(self, episodes: int, budget: int) -> float:
        """Epsilon after so many episodes of a budget."""
        done = min(episodes / (self.cooled * budget), 1.0)
        return self.first_chance + done * (self.last_chance - self.first_chance)
