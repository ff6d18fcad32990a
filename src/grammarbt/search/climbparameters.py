"""The parameters that searchers which climb have in common."""

from __future__ import annotations

from attrs import field, frozen, validators


@frozen
class ClimbParameters:
    """When to race, how long, and when to restart."""

    first_trees: int = field(
        default=60,
        validator=validators.ge(1),
        metadata={"help": "random trees that the first root is chosen from"},
    )
    restart_trees: int = field(
        default=30,
        validator=validators.ge(1),
        metadata={"help": "random trees that a later root is chosen from"},
    )
    restart_after: int = field(
        default=500,
        validator=validators.ge(1),
        metadata={"help": "episodes without an accepted proposal before a restart"},
    )
    race_episodes: int = field(
        default=96,
        validator=validators.ge(1),
        metadata={"help": "episodes of the longest race against the root"},
    )
    duel_episodes: int = field(
        default=48,
        validator=validators.ge(1),
        metadata={"help": "common episodes on which the roots of past restarts are compared"},
    )
    round_episodes: int | None = field(
        default=None,
        validator=validators.optional(validators.ge(1)),
        metadata={
            "help": "where one episode tells a tree's worth: episodes in which the first round of annealing cools down; later "
            "rounds are longer; unset: a sixteenth of the budget, but no more than 3,000"
        },
    )
