"""Leaves that can never run, whatever the world does.

A leaf is dead when no answers that the leaves before it may give lead to it: behind an action that never fails in a
fallback, or, where conditions are pure, behind two conditions that exclude each other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from attrs import frozen

from grammarbt.bt.canonical import all_pure
from grammarbt.bt.model import Action, BehaviorTree, Condition, Leaf, leaves
from grammarbt.bt.policy import Entry, FlatTree, flatten
from grammarbt.bt.status import Status

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from collections.abc import Set as AbstractSet

Known: TypeAlias = frozenset[tuple[Leaf, Status]]
"""What pure conditions have answered since the last action."""

MAX_STATES = 20_000
"""Steps, each with what is known there, looked at before knowledge is dropped; then fewer leaves are found dead."""

_ANY = frozenset(Status)
_YES_OR_NO = frozenset({Status.SUCCESS, Status.FAILURE})


@frozen
class DeadLeaf:
    """A leaf that no tick reaches.

    Attributes:
        leaf: which.
        occurrence: its place among the tree's leaves, left to right from 0.
    """

    leaf: Leaf
    occurrence: int


def dead_leaves(
    tree: BehaviorTree,
    results: Mapping[Leaf, AbstractSet[Status]] | None = None,
    is_pure: Callable[[Condition], bool] = all_pure,
) -> tuple[DeadLeaf, ...]:
    """The leaves that can never run, left to right.

    Args:
        tree: any tree.
        results: the answers an action may give; all three where it is not named.
        is_pure: whether a condition draws no randomness and changes only when an action runs.
    """
    reached = _reached(flatten(tree), results or {}, is_pure)
    return tuple(DeadLeaf(leaf, at) for at, leaf in enumerate(leaves(tree)) if at not in reached)


def _reached(
    flat: FlatTree, results: Mapping[Leaf, AbstractSet[Status]], is_pure: Callable[[Condition], bool]
) -> frozenset[int]:
    """Occurrences of the leaves that some answers lead to."""
    seen: set[tuple[int, Known]] = set()
    stack: list[tuple[int, Known]] = [(flat.entry, frozenset())]
    while stack:
        at, known = stack.pop()
        if len(seen) >= MAX_STATES:
            known = frozenset()
        if at < 0 or (at, known) in seen:
            continue
        seen.add((at, known))
        entry = flat.entries[at]
        statuses = _answers(entry.leaf, known, results)
        stack += [(_next(entry, status), _learnt(entry.leaf, status, known, is_pure)) for status in statuses]
    return frozenset(flat.entries[at].occurrence for at, _ in seen)


def _answers(leaf: Leaf, known: Known, results: Mapping[Leaf, AbstractSet[Status]]) -> Iterator[Status]:
    certain = {status for asked, status in known if asked == leaf}
    possible = certain or (results.get(leaf, _ANY) if isinstance(leaf, Action) else _YES_OR_NO)
    return (status for status in Status if status in possible)


def _learnt(leaf: Leaf, status: Status, known: Known, is_pure: Callable[[Condition], bool]) -> Known:
    if isinstance(leaf, Action):
        return frozenset()
    return known | {(leaf, status)} if is_pure(leaf) else known


def _next(entry: Entry, status: Status) -> int:
    return {Status.SUCCESS: entry.on_success, Status.FAILURE: entry.on_failure}.get(status, entry.on_running)
