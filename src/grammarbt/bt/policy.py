"""Compiling a tree to its flat policy, and ticking that.

Ticks are memoryless: each starts at the root. So a tree is a list of leaves and, for each answer a leaf may give, the
leaf to visit next or the result of the tick. Control flow costs nothing at run time, and trees that differ only in
associativity, single children or double negation compile to the same policy.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np
from attrs import field, frozen
from numpy.typing import NDArray

from grammarbt.bt.model import Action, BehaviorTree, Condition, Fallback, Leaf, Node, Not, Parallel, Sequence
from grammarbt.bt.notation import format_leaf
from grammarbt.bt.status import Status
from grammarbt.errors import DomainError, did_you_mean

IntArray: TypeAlias = NDArray[np.int32]

SUCCESS, FAILURE, RUNNING = -1, -2, -3
"""Ends of a tick, in the place of a next entry."""

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


Continuation: TypeAlias = Callable[[], int]


def flatten(tree: BehaviorTree) -> FlatTree:
    """Compile a tree; unreachable leaves have no entry, and entries are numbered in the order of first visit.

    Raises:
        DomainError: nested parallel nodes need more than `MAX_ENTRIES` entries.
    """
    compiler = _Compiler()
    start = compiler.compile(tree, 0, SUCCESS, FAILURE, RUNNING)
    return compiler.renumbered(start)


def compile_policy(tree: BehaviorTree, index: Mapping[Leaf, int]) -> Policy:
    """Compile a tree for a domain whose leaves are numbered by `index`.

    Raises:
        DomainError: the tree uses a leaf that the domain does not have.
    """
    flat = flatten(tree)
    rows = [
        (_number(entry.leaf, index), entry.occurrence, entry.on_success, entry.on_failure, entry.on_running)
        for entry in flat.entries
    ]
    leaf, occurrence, on_success, on_failure, on_running = np.array(rows, dtype=np.int32).T.copy()
    return Policy(leaf, occurrence, on_success, on_failure, on_running, flat.occurrences, tree)


def tick(flat: FlatTree, answer: Callable[[Leaf, int], Status]) -> Status:
    """Tick once; `answer(leaf, occurrence)` asks the world."""
    at = flat.entry
    while at >= 0:
        entry = flat.entries[at]
        status = answer(entry.leaf, entry.occurrence)
        at = _next(entry, status)
    return _STATUS[at]


def _next(entry: Entry, status: Status) -> int:
    if status is Status.SUCCESS:
        return entry.on_success
    return entry.on_failure if status is Status.FAILURE else entry.on_running


def _number(leaf: Leaf, index: Mapping[Leaf, int]) -> int:
    number = index.get(leaf)
    if number is None:
        known = [format_leaf(other) for other in index]
        raise DomainError(f"the domain has no leaf {format_leaf(leaf)}", did_you_mean(format_leaf(leaf), known))
    return number


class _Compiler:
    """Compiles from right to left, so that where a leaf leads is known before the leaf itself."""

    def __init__(self) -> None:
        self.entries: list[Entry] = []
        self.known: dict[tuple[int, int, int, int], int] = {}
        self.sizes: dict[int, int] = {}
        self.total = 0

    def compile(self, node: Node, first: int, success: int, failure: int, running: int) -> int:
        """The index at which ticking `node` starts; `first` is the occurrence of its first leaf."""
        if isinstance(node, Action | Condition):
            return self.leaf(node, first, success, failure, running)
        if isinstance(node, Not):
            return self.compile(node.child, first, failure, success, running)
        if isinstance(node, Parallel):
            return self.parallel(node, first, success, failure, running)
        at = success if isinstance(node, Sequence) else failure
        for child, start in reversed(self.placed(node, first)):
            if isinstance(node, Sequence):
                at = self.compile(child, start, at, failure, running)
            else:
                at = self.compile(child, start, success, at, running)
        return at

    def leaf(self, leaf: Leaf, occurrence: int, success: int, failure: int, running: int) -> int:
        self.total = max(self.total, occurrence + 1)
        key = (occurrence, success, failure, running)
        if key not in self.known:
            if len(self.entries) >= MAX_ENTRIES:
                raise DomainError(
                    f"the tree's parallel nodes unroll to more than {MAX_ENTRIES:,} steps", "nest fewer of them"
                )
            self.known[key] = len(self.entries)
            self.entries.append(Entry(leaf, occurrence, success, failure, running))
        return self.known[key]

    def parallel(self, node: Parallel, first: int, success: int, failure: int, running: int) -> int:
        """Unroll the counters: one copy of a child per (successes, failures) it may find."""
        parts = self.placed(node, first)
        allowed = len(parts) - node.successes
        memo: dict[tuple[int, int, int], int] = {}

        def at(index: int, won: int, lost: int) -> int:
            if won == node.successes:
                return success
            if lost > allowed:
                return failure
            if index == len(parts):
                return running
            key = (index, won, lost)
            if key not in memo:
                child, start = parts[index]
                after = (at(index + 1, won + 1, lost), at(index + 1, won, lost + 1), at(index + 1, won, lost))
                memo[key] = self.compile(child, start, *after)
            return memo[key]

        return at(0, 0, 0)

    def placed(self, node: Fallback | Sequence | Parallel, first: int) -> list[tuple[Node, int]]:
        placed = []
        for child in node.children:
            placed.append((child, first))
            first += self.size(child)
        self.total = max(self.total, first)
        return placed

    def size(self, node: Node) -> int:
        if isinstance(node, Action | Condition):
            return 1
        if id(node) not in self.sizes:  # the tree outlives the compiler, so an id stays one node's
            parts = (node.child,) if isinstance(node, Not) else node.children
            self.sizes[id(node)] = sum(self.size(part) for part in parts)
        return self.sizes[id(node)]

    def renumbered(self, start: int) -> FlatTree:
        """Drop what no tick reaches, and number the rest in pre-order: success first."""
        order: dict[int, int] = {}
        stack = [start]
        while stack:
            at = stack.pop()
            if at < 0 or at in order:
                continue
            order[at] = len(order)
            entry = self.entries[at]
            stack.extend((entry.on_running, entry.on_failure, entry.on_success))

        def new(at: int) -> int:
            return order.get(at, at)

        entries = tuple(
            Entry(entry.leaf, entry.occurrence, new(entry.on_success), new(entry.on_failure), new(entry.on_running))
            for entry in (self.entries[at] for at in order)
        )
        return FlatTree(entries, 0, self.total)
