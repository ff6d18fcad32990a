"""A policy in the form that compiled code reads, and how that is compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeVar, cast

import numba
import numpy as np
from numpy.typing import NDArray

from grammarbt.bt import Status, walk
from grammarbt.domain.sources import stamped
from grammarbt_pickplace.state import Records

if TYPE_CHECKING:
    from grammarbt.bt import Policy

LEAVES = (
    *("move to pick0", "move to pick1", "move to pick2", "move to place"),
    *("tuck", "pick", "place", "localise", "head up", "head down"),
    *("have block", "task done", "cube0 placed", "cube1 placed", "cube2 placed"),
    *("table0 visited", "table1 visited", "table2 visited"),
)
"""What the simulator knows, actions first; a leaf's place here is its code in a program."""

FAILURE, SUCCESS, RUNNING = int(Status.FAILURE), int(Status.SUCCESS), int(Status.RUNNING)
SUCCEEDED, FAILED = -1, -2
"""Ends of a tick, in the place of a next entry."""

ENTRY = np.dtype([("leaf", np.int32), ("occurrence", np.int32), ("follow", np.int32, (3,))], align=True)
"""An entry of a program: its leaf's code, its occurrence, and by status the next entry or the end of the tick."""


class Program(NamedTuple):
    """A policy with the simulator's codes: (E,) entries of dtype `ENTRY`, and the number of nodes of the tree."""

    entries: Records
    nodes: int


def make_program(policy: Policy, codes: NDArray[np.int32]) -> Program:
    """The policy as a program; `codes` is the place in `LEAVES` of each leaf of the vocabulary."""
    entries = np.empty(len(policy.leaf), dtype=ENTRY)
    entries["leaf"] = codes[policy.leaf]
    entries["occurrence"] = policy.occurrence
    follow = entries["follow"]
    follow[:, SUCCESS] = policy.on_success
    follow[:, FAILURE] = policy.on_failure
    follow[:, RUNNING] = policy.on_running
    return Program(entries, sum(1 for _ in walk(policy.tree)))


Function = TypeVar("Function", bound=Callable[..., object])


def compiled(function: Function) -> Function:
    """`numba.njit` that keeps the function's type; to be called by compiled functions only."""
    return cast("Function", numba.njit(function))


def cached(function: Function) -> Function:
    """`compiled`, with all that it calls kept on disk until a source of this package changes."""
    return cast("Function", numba.njit(cache=True)(stamped(function)))
