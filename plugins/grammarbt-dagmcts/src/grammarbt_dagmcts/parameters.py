"""The parameters of the searcher, with their help texts."""

from __future__ import annotations

from typing import Literal

from attrs import field, frozen, validators

from grammarbt.search import BanditName, ClimbParameters

Preset = Literal["default", "paper"]


@frozen
class DagMctsParameters(ClimbParameters):
    """How to search; fields that only one preset reads say so."""

    preset: Preset = field(
        default="default",
        validator=validators.in_(("default", "paper")),
        metadata={"help": "default: DAG search re-rooted at the incumbent tree; paper: the published method"},
    )
    bandit: BanditName = field(
        default="ucb1",
        validator=validators.in_(("ucb1", "ucb1-tuned", "ucb1-normal2", "threshold-ascent")),
        metadata={"help": "rule that selects among the children of a node"},
    )
    c: float | None = field(
        default=None,
        validator=validators.optional(validators.ge(0.0)),
        metadata={"help": "exploration constant of UCB1; unset: 1 for paper, 0.4 for default"},
    )

    ancestor_links: bool = field(
        default=True, metadata={"help": "paper: search for each new node's ancestors and join them to it"}
    )
    k: int = field(
        default=3,
        validator=validators.ge(1),
        metadata={"help": "paper: inverse productions up to which ancestors are searched for"},
    )
    most_ancestors: int = field(
        default=1_000,
        validator=validators.ge(1),
        metadata={"help": "paper: sentential forms looked at in one search for ancestors"},
    )
    restart_every: int = field(
        default=1_000,
        validator=validators.ge(0),
        metadata={"help": "paper: episodes between restarts; 0 never restarts"},
    )
    macros: int = field(
        default=10,
        validator=validators.ge(0),
        metadata={
            "help": "paper: most promising sub-trees that become productions at a restart; 0 is without extension"
        },
    )

    trim: bool = field(
        default=True,
        metadata={"help": "default: drop sub-trees that were never ticked, insert only where the root's ticks arrive"},
    )
    largest_block: int = field(
        default=20_000,
        validator=validators.ge(1),
        metadata={
            "help": "default: words of a group's sub-tree up to which they are listed; larger groups are sampled"
        },
    )
    trace: str | None = field(
        default=None,
        metadata={"help": "GraphML file for the DAG with its statistics, written when the search ends"},
    )
