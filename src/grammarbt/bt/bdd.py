"""Decision graphs: what a tick does, with everything that makes no difference removed.

A node is a *call* – a leaf is ticked, and each of its answers leads on – or a *test* of a pure condition. Between two
calls the world stands still, so tests form ordered binary decision diagrams (Bryant, *Graph-Based Algorithms for Boolean
Function Manipulation*, 1986) whose ends are calls and results. Nodes are hash-consed: equal nodes have equal numbers.
"""

from __future__ import annotations

from typing import TypeAlias

from grammarbt.bt.compiler import RUNNING

GraphNode: TypeAlias = tuple[str, int, int, int]
"""The leaf in notation, and the nodes that follow success, failure and running."""


class TooLargeError(Exception):
    """The graph has grown past its limit; whoever asked for it takes a coarser one."""


class DecisionGraph:
    """A growing graph; results of a tick are the negative numbers SUCCESS, FAILURE and RUNNING.

    Attributes:
        nodes: what each number stands for.
        tests: the nodes that test a pure condition, with that condition.
    """

    def __init__(self, most_nodes: int) -> None:
        self.nodes: list[GraphNode] = []
        self.tests: dict[int, str] = {}
        self._most_nodes = most_nodes
        self._known: dict[GraphNode, int] = {}
        self._sorted: dict[tuple[str, int, int], int] = {}

    def call(self, leaf: str, success: int, failure: int, running: int) -> int:
        """The node that ticks `leaf`."""
        node = (leaf, success, failure, running)
        at = self._known.get(node)
        return self._add(node) if at is None else at

    def test(self, condition: str, true: int, false: int) -> int:
        """The node that behaves like `true` where the condition holds and like `false` where not."""
        if true == false:
            return true
        in_true, in_false = self.tests.get(true), self.tests.get(false)
        if (in_true is not None and in_true <= condition) or (in_false is not None and in_false <= condition):
            return self._ordered(condition, true, false)
        node = (condition, true, false, RUNNING)
        at = self._known.get(node)
        if at is None:
            at = self._add(node)
            self.tests[at] = condition
        return at

    def _add(self, node: GraphNode) -> int:
        at = self._known[node] = len(self.nodes)
        if at >= self._most_nodes:
            raise TooLargeError
        self.nodes.append(node)
        return at

    def _ordered(self, condition: str, true: int, false: int) -> int:
        """A test where what follows asks conditions that come before it, or asks it again."""
        key = (condition, true, false)
        at = self._sorted.get(key)
        if at is None:
            at = self._sorted[key] = self._sort(condition, true, false)
        return at

    def _sort(self, condition: str, true: int, false: int) -> int:
        first = min(condition, self.tests.get(true, condition), self.tests.get(false, condition))
        true_high, true_low = self._answers(first, true)
        false_high, false_low = self._answers(first, false)
        if first == condition:
            return self.test(condition, true_high, false_low)
        high = self.test(condition, true_high, false_high)
        return self.test(first, high, self.test(condition, true_low, false_low))

    def _answers(self, condition: str, node: int) -> tuple[int, int]:
        """Where a node leads when the condition holds, and where when not."""
        if self.tests.get(node) != condition:
            return node, node
        _, true, false, _ = self.nodes[node]
        return true, false
