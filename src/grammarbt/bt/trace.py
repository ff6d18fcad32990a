"""From the answers of a tick's leaves to what every node of the tree answered."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.bt.model import Action, BehaviorTree, Condition, Node, Not, Parallel, numbered
from grammarbt.bt.status import Status

if TYPE_CHECKING:
    from collections.abc import Mapping

_SWAPPED = {Status.SUCCESS: Status.FAILURE, Status.FAILURE: Status.SUCCESS, Status.RUNNING: Status.RUNNING}


def node_statuses(tree: BehaviorTree, seen: Mapping[int, Status]) -> tuple[Status | None, ...]:
    """What each node answered in a tick, in pre-order; None for those not ticked.

    Args:
        tree: the tree that was ticked.
        seen: the answers of the leaves that were ticked, by occurrence.
    """
    nodes = numbered(tree)
    ticked: list[list[Status]] = [[] for _ in nodes]
    statuses: list[Status | None] = [None] * len(nodes)
    occurrence = sum(isinstance(node, Action | Condition) for node, _ in nodes)
    for at in reversed(range(len(nodes))):
        node, parent = nodes[at]
        if isinstance(node, Action | Condition):
            occurrence -= 1
            statuses[at] = seen.get(occurrence)
        elif ticked[at]:
            statuses[at] = _status(node, ticked[at])
        status = statuses[at]
        if parent is not None and status is not None:
            ticked[parent].append(status)
    return tuple(statuses)


def _status(node: Node, ticked: list[Status]) -> Status:
    """The status of a control node whose ticked children, the last first, answered so."""
    if isinstance(node, Not):
        return _SWAPPED[ticked[0]]
    if not isinstance(node, Parallel):
        return ticked[0]  # a fallback or a sequence ends with the child that decides it
    if ticked.count(Status.SUCCESS) == node.successes:
        return Status.SUCCESS
    too_many = len(node.children) - node.successes
    return Status.FAILURE if ticked.count(Status.FAILURE) > too_many else Status.RUNNING
