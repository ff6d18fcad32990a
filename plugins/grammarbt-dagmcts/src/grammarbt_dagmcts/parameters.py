"""The parameters of the searcher, with their help texts."""

from __future__ import annotations

from typing import Literal, get_args

from attrs import field, frozen, validators

from grammarbt.search import BanditName, ClimbParameters

Preset = Literal["default", "paper", "mcdags"]


@frozen
class DagMctsParameters(ClimbParameters):
    """How to search; fields that only one preset reads say so."""

    preset: Preset = field(
        default="default",
        validator=validators.in_(get_args(Preset)),
        metadata={
            "help": "default: DAG search re-rooted at the incumbent tree; paper: the published method of 2020; mcdags: "
            "the same authors' of 2021, with annealing"
        },
    )
    bandit: BanditName = field(
        default="ucb1",
        validator=validators.in_(get_args(BanditName)),
        metadata={"help": "rule that selects: among the children of a node, in the default what kind of change to try"},
    )
    c: float | None = field(
        default=None,
        validator=validators.optional(validators.ge(0.0)),
        metadata={"help": "exploration constant of UCB1; unset: 1 for paper and mcdags, 0.4 for default"},
    )

    dag: bool = field(
        default=True,
        metadata={
            "help": "paper, mcdags: one node per sentential form; false: a tree, in which equal forms stay apart"
        },
    )
    ancestor_links: bool = field(
        default=True, metadata={"help": "paper, mcdags: search for ancestors of nodes and join them; needs dag=true"}
    )
    k: int = field(
        default=3,
        validator=validators.ge(1),
        metadata={"help": "paper, mcdags: inverse productions up to which ancestors are searched for"},
    )
    most_ancestors: int = field(
        default=1_000,
        validator=validators.ge(1),
        metadata={"help": "paper, mcdags: sentential forms looked at in one search for ancestors"},
    )
    roll_out: int | None = field(
        default=None,
        validator=validators.optional(validators.ge(0)),
        metadata={
            "help": "paper, mcdags: random productions of a roll-out, after which the tree is finished the shortest way; "
            "unset: 2,000 for paper, 40 for mcdags"
        },
    )
    restarts: bool = field(default=True, metadata={"help": "paper, mcdags: begin a new DAG every now and then"})
    restart_every: int = field(
        default=1_000,
        validator=validators.ge(0),
        metadata={"help": "paper: episodes between restarts; 0 never restarts"},
    )
    macros: int = field(
        default=10,
        validator=validators.ge(0),
        metadata={
            "help": "paper, mcdags: most promising sub-trees that become productions at a restart; 0 is without extension"
        },
    )

    annealing: bool = field(
        default=True,
        metadata={"help": "mcdags: anneal the order of known sub-trees in every other round; false: search in all"},
    )
    round_length: int | None = field(
        default=None,
        validator=validators.optional(validators.ge(1)),
        metadata={"help": "mcdags: episodes of a round; unset: a fiftieth of the budget, but no more than 1,000"},
    )
    search_rounds: int = field(
        default=10,
        validator=validators.ge(1),
        metadata={"help": "mcdags: rounds before searching and annealing take turns"},
    )
    link_every: int | None = field(
        default=None,
        validator=validators.optional(validators.ge(1)),
        metadata={
            "help": "mcdags: episodes between searches for the ancestors of each level's best node; unset: a fifth of a "
            "round"
        },
    )
    heat: float = field(
        default=0.3,
        validator=validators.gt(0.0),
        metadata={"help": "mcdags: first temperature of a round, in standard deviations of the returns"},
    )
    reset_after: int = field(
        default=100,
        validator=validators.ge(1),
        metadata={"help": "mcdags: steps of annealing without gain after which it goes on from the best list"},
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
        metadata={
            "help": "GraphML file for the DAG with its statistics, written when the search ends; the DAGs that restarts end "
            "go to files with a number beside it"
        },
    )
