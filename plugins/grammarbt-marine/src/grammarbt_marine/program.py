"""A policy in the form that compiled code reads, and how that is compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeVar, cast

import numba
import numpy as np
from numpy.typing import NDArray

from grammarbt.bt import Status
from grammarbt.domain.sources import stamped
from grammarbt_marine.records import Records

if TYPE_CHECKING:
    from grammarbt.bt import Policy

LEAVES = (
    *("go to comms", "resurface", "report", "disarm", "pick up", "take to drop off"),
    *("go to likely target", "random walk", "shortest path", "coverage"),
    *("in comms", "target found", "at surface", "mine found", "is armed"),
    *("object found", "carrying object", "likely target found", "battery low"),
)
"""What the simulator knows, actions first; a leaf's place here is its code in a program."""

FAILURE, SUCCESS, RUNNING = int(Status.FAILURE), int(Status.SUCCESS), int(Status.RUNNING)

ENTRY = np.dtype([("leaf", np.int32), ("occurrence", np.int32), ("follow", np.int32, (3,))], align=True)
"""An entry of a program: its leaf's code, its occurrence, and by status the next entry or the end of the tick."""


class Program(NamedTuple):
    """A policy with the simulator's codes.

    Attributes:
        entries: (E,) of dtype `ENTRY`.
        ticks: (L,) how often each leaf of the tree was ticked; the simulator counts here.
    """

    entries: Records
    ticks: NDArray[np.int64]


def make_program(policy: Policy, codes: NDArray[np.int32]) -> Program:
    """The policy as a program; `codes` is the place in `LEAVES` of each leaf of the vocabulary."""
    entries = np.empty(len(policy.leaf), dtype=ENTRY)
    entries["leaf"] = codes[policy.leaf]
    entries["occurrence"] = policy.occurrence
    follow = entries["follow"]
    follow[:, SUCCESS] = policy.on_success
    follow[:, FAILURE] = policy.on_failure
    follow[:, RUNNING] = policy.on_running
    return Program(entries, np.zeros(policy.occurrences, dtype=np.int64))


Function = TypeVar("Function", bound=Callable[..., object])


def compiled(function: Function) -> Function:
    """`numba.njit` that keeps the function's type; to be called by compiled functions only."""
    return cast("Function", numba.njit(function))


def cached(function: Function) -> Function:
    """`compiled`, with all that it calls kept on disk until a source of this package changes."""
    return cast("Function", numba.njit(cache=True)(stamped(function)))
