"""Compiling a tree to its flat policy, and ticking that.

Ticks are memoryless: each starts at the root. So a tree is a list of leaves and, for each answer a leaf may give, the
leaf to visit next or the result of the tick. Control flow costs nothing at run time, and trees that differ only in
associativity, single children or double negation compile to the same policy.
"""

from __future__ import annotations

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


@frozen(eq=False)
class Policy:
    """A compiled tree over a domain's numbered leaves, as arrays of equal length that compiled simulators read.

    Attributes:
        leaf: index into `Vocabulary.leaves`, per entry.
        occurrence: place of the leaf in the tree, per entry; ticks are counted by it.
        on_success, on_failure, on_running: next entry, or SUCCESS (-1), FAILURE (-2), RUNNING (-3).
        occurrences: leaves of the tree.
        tree: what was compiled.
    """

    leaf: IntArray
    occurrence: IntArray
    on_success: IntArray
    on_failure: IntArray
    on_running: IntArray
    occurrences: int
    tree: BehaviorTree = field(repr=False)


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
    names, *columns = zip(*_rows(steps), strict=True)
    try:
        numbers = [index[leaf] for leaf in names]
    except KeyError:
        raise _unknown(tree, index) from None
    leaf, occurrence, on_success, on_failure, on_running = np.array([numbers, *columns], dtype=np.int32)
    return Policy(leaf, occurrence, on_success, on_failure, on_running, steps.occurrences, tree)


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
