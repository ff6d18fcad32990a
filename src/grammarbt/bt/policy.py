"""Compiling a tree to its flat policy, and ticking that.

Ticks are memoryless: each starts at the root. So a tree is a list of leaves and, for each answer a leaf may give, the
leaf to visit next or the result of the tick. Control flow costs nothing at run time, and trees that differ only in
associativity, single children or double negation compile to the same policy.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from attrs import field, frozen
from numpy.typing import NDArray

from grammarbt.bt.compiler import FAILURE, RUNNING, SUCCESS, Steps, compile_steps
from grammarbt.bt.model import BehaviorTree, Leaf, leaves
from grammarbt.bt.notation import format_leaf
from grammarbt.bt.status import Status
from grammarbt.errors import DomainError, did_you_mean

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

IntArray: TypeAlias = NDArray[np.int32]

_STATUS = {SUCCESS: Status.SUCCESS, FAILURE: Status.FAILURE, RUNNING: Status.RUNNING}


@frozen
class Entry:
    """One step of a policy.

    Attributes:
        leaf: the leaf to tick.
        occurrence: the leaf's place among the tree's leaves, left to right from 0.
        on_success, on_failure, on_running: the next entry's index, or SUCCESS, FAILURE or RUNNING. Only inside a
            parallel node does a running leaf not end the tick.
    """

    leaf: Leaf
    occurrence: int
    on_success: int
    on_failure: int
    on_running: int = RUNNING


@frozen
class FlatTree:
    """A compiled tree, independent of any domain; entry 0 (or `entry`) is where a tick starts."""

    entries: tuple[Entry, ...]
    entry: int
    occurrences: int


@frozen(eq=False, slots=False)  # slots=False: cached_property keeps its value in the instance's dict
class Policy:
    """A compiled tree over a domain's numbered leaves, as arrays of equal length that compiled simulators read.

    The arrays are made when the first of them is asked for: a simulator in Python ticks the tree without them.

    Attributes:
        occurrences: leaves of the tree.
        tree: what was compiled.
    """

    occurrences: int
    tree: BehaviorTree = field(repr=False)
    _steps: Steps = field(repr=False)
    _numbers: list[int] = field(repr=False)

    @property
    def leaf(self) -> IntArray:
        """Index into `Vocabulary.leaves`, per entry."""
        return self._columns[0]

    @property
    def occurrence(self) -> IntArray:
        """Place of the leaf in the tree, per entry; ticks are counted by it."""
        return self._columns[1]

    @property
    def on_success(self) -> IntArray:
        """Next entry after success, or SUCCESS (-1), FAILURE (-2), RUNNING (-3)."""
        return self._columns[2]

    @property
    def on_failure(self) -> IntArray:
        """The same after failure."""
        return self._columns[3]

    @property
    def on_running(self) -> IntArray:
        """The same after running."""
        return self._columns[4]

    @cached_property
    def _columns(self) -> tuple[IntArray, ...]:
        _, *columns = zip(*_rows(self._steps), strict=True)
        return tuple(np.array([self._numbers[::-1], *columns], dtype=np.int32))


def flatten(tree: BehaviorTree) -> FlatTree:
    """Compile a tree; unreachable leaves have no entry, and an entry comes before those it leads to.

    Raises:
        DomainError: nested parallel nodes need more than `MAX_STEPS` steps.
    """
    steps = compile_steps(tree)
    return FlatTree(tuple([Entry(*row) for row in _rows(steps)]), 0, steps.occurrences)


def compile_policy(tree: BehaviorTree, index: Mapping[Leaf, int]) -> Policy:
    """Compile a tree for a domain whose leaves are numbered by `index`.

    Raises:
        DomainError: the tree uses a leaf that the domain does not have, or as `flatten`.
    """
    steps = compile_steps(tree)
    try:
        numbers = [index[step[0]] for step in steps.steps]
    except KeyError:
        raise _unknown(tree, index) from None
    return Policy(steps.occurrences, tree, steps, numbers)


def tick(flat: FlatTree, answer: Callable[[Leaf, int], Status]) -> Status:
    """Tick once; `answer(leaf, occurrence)` asks the world."""
    at, entries, success, failure = flat.entry, flat.entries, Status.SUCCESS, Status.FAILURE
    while at >= 0:
        entry = entries[at]
        status = answer(entry.leaf, entry.occurrence)
        if status is success:
            at = entry.on_success
        elif status is failure:
            at = entry.on_failure
        else:
            at = entry.on_running
    return _STATUS[at]


def _rows(steps: Steps) -> list[tuple[Leaf, int, int, int, int]]:
    """The fields of the entries: the steps from left to right."""
    new = [*reversed(range(len(steps.steps))), RUNNING, FAILURE, SUCCESS]  # at -3, -2 and -1, as steps name the ends
    leaves_before = steps.occurrences
    return [
        (leaf, leaves_before + behind, new[success], new[failure], new[running])
        for leaf, behind, success, failure, running in reversed(steps.steps)
    ]


def _unknown(tree: BehaviorTree, index: Mapping[Leaf, int]) -> DomainError:
    leaf = next(leaf for leaf in leaves(tree) if leaf not in index)
    known = [format_leaf(other) for other in index]
    return DomainError(f"the domain has no leaf {format_leaf(leaf)}", did_you_mean(format_leaf(leaf), known))
