"""A policy in the form that compiled simulators read."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeVar, cast

import numba
import numpy as np
from numpy.typing import NDArray

from grammarbt.bt import Status
from grammarbt.domain.sources import stamped

if TYPE_CHECKING:
    from grammarbt.bt import Policy

FAILURE, SUCCESS, RUNNING = int(Status.FAILURE), int(Status.SUCCESS), int(Status.RUNNING)

Function = TypeVar("Function", bound=Callable[..., object])


class Program(NamedTuple):
    """A policy of E entries over a tree with L leaves.

    Attributes:
        leaf: (E,) index into the vocabulary's leaves.
        occurrence: (E,) place of the leaf in the tree.
        follow: (E, 3) by status the next entry; negative at the end of the tick.
        ticks: (L,) how often each leaf of the tree was ticked; simulators count here.
    """

    leaf: NDArray[np.int32]
    occurrence: NDArray[np.int32]
    follow: NDArray[np.int32]
    ticks: NDArray[np.int64]


def make_program(policy: Policy) -> Program:
    """The policy as a program that has not ticked yet."""
    follow = np.empty((len(policy.leaf), 3), dtype=np.int32)
    follow[:, SUCCESS] = policy.on_success
    follow[:, FAILURE] = policy.on_failure
    follow[:, RUNNING] = policy.on_running
    return Program(policy.leaf, policy.occurrence, follow, np.zeros(policy.occurrences, dtype=np.int64))


def compiled(function: Function) -> Function:
    """`numba.njit` that keeps the function's type; to be called by compiled functions only."""
    return cast("Function", numba.njit(function))


def inlined(function: Function) -> Function:
    """`compiled`, for what is called most: as part of its caller it need not count references to the world's arrays."""
    return cast("Function", numba.njit(forceinline=True)(function))


def cached(function: Function) -> Function:
    """`compiled`, with all that it calls kept on disk until a source of this package changes."""
    return cast("Function", numba.njit(cache=True)(stamped(function)))
