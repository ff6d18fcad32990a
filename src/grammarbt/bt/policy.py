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

from grammarbt.bt.compiler import FAILURE, RUNNING, SUCCESS, Compiler, visit_order
from grammarbt.bt.model import BehaviorTree, Leaf
from grammarbt.bt.notation import format_leaf
from grammarbt.bt.status import Status
from grammarbt.errors import DomainError, did_you_mean

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

IntArray: TypeAlias = NDArray[np.int32]

Step: TypeAlias = tuple[int, int, int, int]
_STATUS = {SUCCESS: Status.SUCCESS, FAILURE: Status.FAILURE, RUNNING: Status.RUNNING}
MAX_ENTRIES = 100_000


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
    """Compile a tree; unreachable leaves have no entry, and entries are numbered in the order of first visit.

    Raises:
        DomainError: nested parallel nodes need more than `MAX_ENTRIES` entries.
    """
    flattener = _Flattener(tree)
    return FlatTree(tuple(Entry(*row) for row in flattener.rows()), 0, flattener.occurrences)


def compile_policy(tree: BehaviorTree, index: Mapping[Leaf, int]) -> Policy:
    """Compile a tree for a domain whose leaves are numbered by `index`.

    Raises:
        DomainError: the tree uses a leaf that the domain does not have.
    """
    flattener = _Flattener(tree)
    rows = [
        (_number(leaf, index), at, success, failure, running)
        for leaf, at, success, failure, running in flattener.rows()
    ]
    leaf, occurrence, on_success, on_failure, on_running = np.array(rows, dtype=np.int32).T.copy()
    return Policy(leaf, occurrence, on_success, on_failure, on_running, flattener.occurrences, tree)


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


def _number(leaf: Leaf, index: Mapping[Leaf, int]) -> int:
    number = index.get(leaf)
    if number is None:
        known = [format_leaf(other) for other in index]
        raise DomainError(f"the domain has no leaf {format_leaf(leaf)}", did_you_mean(format_leaf(leaf), known))
    return number


class _Flattener(Compiler):
    """Gives every leaf one step per way of going on after it; steps name leaves by how far they are from the end."""

    def __init__(self, tree: BehaviorTree) -> None:
        super().__init__()
        self.steps: list[Step] = []
        self.leaves: list[Leaf] = []
        self.known: dict[Step, int] = {}
        self.first = self.start(tree)
        self.occurrences = -self.behind

    def leaf(self, leaf: Leaf, success: int, failure: int, running: int) -> int:
        key = (self.behind, success, failure, running)
        at = self.known.get(key)
        if at is None:
            at = self.known[key] = len(self.steps)
            if at >= MAX_ENTRIES:
                raise DomainError(
                    f"the tree's parallel nodes unroll to more than {MAX_ENTRIES:,} steps", "nest fewer of them"
                )
            self.steps.append(key)
            self.leaves.append(leaf)
        return at

    def rows(self) -> Iterator[tuple[Leaf, int, int, int, int]]:
        """The fields of the entries: without what no tick reaches, and numbered in the order of first visit."""
        order = visit_order(self.steps, self.first)
        new = {**order, SUCCESS: SUCCESS, FAILURE: FAILURE, RUNNING: RUNNING}
        for at in order:
            behind, success, failure, running = self.steps[at]
            yield self.leaves[at], self.occurrences + behind, new[success], new[failure], new[running]
