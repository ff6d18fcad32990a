"""From a tree to steps: which leaf is ticked, and where each of its answers leads.

Ticks are memoryless, so control nodes need no run time: compiling from right to left, what follows a leaf is known
before the leaf itself. Associativity, single children, double negation and De Morgan's laws disappear on the way.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

from grammarbt.bt.model import Action, BehaviorTree, Condition, Fallback, Leaf, Node, Not, Parallel, Sequence

if TYPE_CHECKING:
    from collections.abc import Sequence as AbstractSequence

SUCCESS, FAILURE, RUNNING = -1, -2, -3
"""Ends of a tick, in the place of a next step."""

_LEAF = (Action, Condition)


class Compiler(ABC):
    """Walks a tree from right to left; what a leaf becomes is up to the subclass.

    Attributes:
        behind: minus the number of leaves from the present one to the tree's end; so a leaf's occurrence, once the
            number of all leaves is known, is their sum.
    """

    def __init__(self) -> None:
        self.behind = 0
        self._unrolled: dict[tuple[int, int, int, int, int], tuple[int, int]] = {}

    @abstractmethod
    def leaf(self, leaf: Leaf, success: int, failure: int, running: int) -> int:
        """The step that ticks `leaf` and goes on as told."""

    def start(self, tree: BehaviorTree) -> int:
        """The step at which a tick of the tree starts."""
        return self.compile(tree, SUCCESS, FAILURE, RUNNING)

    def compile(self, node: Node, success: int, failure: int, running: int) -> int:
        """The step at which ticking `node` starts, when its answers lead to the given steps."""
        if isinstance(node, _LEAF):
            self.behind -= 1
            return self.leaf(node, success, failure, running)
        if isinstance(node, Sequence):
            for child in reversed(node.children):
                success = self.compile(child, success, failure, running)
            return success
        if isinstance(node, Fallback):
            for child in reversed(node.children):
                failure = self.compile(child, success, failure, running)
            return failure
        if isinstance(node, Not):
            return self.compile(node.child, failure, success, running)
        return self._parallel(node, success, failure, running)

    def _parallel(self, node: Parallel, success: int, failure: int, running: int) -> int:
        """Nested parallels meet the same continuation again and again; unroll it once."""
        key = (id(node), self.behind, success, failure, running)  # the tree outlives the compiler, so ids stay
        if key not in self._unrolled:
            start = self._unroll(node, success, failure, running)
            self._unrolled[key] = (start, self.behind)
        start, self.behind = self._unrolled[key]
        return start

    def _unroll(self, node: Parallel, success: int, failure: int, running: int) -> int:
        """Unroll the counters: one copy of a child per (successes, failures) that it may find."""
        allowed = len(node.children) - node.successes
        after: dict[tuple[int, int], int] = {}

        def go_on(won: int, lost: int) -> int:
            if won == node.successes:
                return success
            return failure if lost > allowed else after.get((won, lost), running)

        for index in reversed(range(len(node.children))):
            behind, before = self.behind, {}
            for won in range(min(index + 1, node.successes)):
                for lost in range(min(index - won, allowed) + 1):
                    self.behind = behind
                    following = (go_on(won + 1, lost), go_on(won, lost + 1), go_on(won, lost))
                    before[won, lost] = self.compile(node.children[index], *following)
            after = before
        return after[0, 0]


def visit_order(steps: AbstractSequence[tuple[Any, ...]], start: int) -> dict[int, int]:
    """Number the steps a tick can reach, in the order of first visit, success first.

    Args:
        steps: each ends with its next steps on success, failure and running.
        start: where a tick starts.
    """
    order: dict[int, int] = {}
    stack = [start]
    while stack:
        at = stack.pop()
        if at >= 0 and at not in order:
            order[at] = len(order)
            _, success, failure, running = steps[at]
            stack += (running, failure, success)
    return order
