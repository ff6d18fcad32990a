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


_LAST = chr(0x10FFFF)
"""Comes after every condition, which begins with a parenthesis."""


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

    def number(self, node: GraphNode) -> int:
        """The number of a node; the same whenever it is asked for."""
        new = len(self.nodes)
        at = self._known.setdefault(node, new)
        if at == new:
            if new >= self._most_nodes:
                raise TooLargeError
            self.nodes.append(node)
        return at

    def test(self, condition: str, true: int, false: int) -> int:
        """The node that behaves like `true` where the condition holds and like `false` where not."""
        if true == false:
            return true
        tests = self.tests
        if condition < tests.get(true, _LAST) and condition < tests.get(false, _LAST):
            at = self.number((condition, true, false, RUNNING))
            tests[at] = condition
            return at
        return self._ordered(condition, true, false)

    def _ordered(self, condition: str, true: int, false: int) -> int:
        """A test where what follows asks conditions that come before it, or asks it again."""
        key = (condition, true, false)
        at = self._sorted.get(key)
        if at is None:
            at = self._sorted[key] = self._sort(condition, true, false)
        return at

    def _sort(self, condition: str, true: int, false: int) -> int:
        in_true, in_false = self.tests.get(true, _LAST), self.tests.get(false, _LAST)
        first = min(condition, in_true, in_false)
        true_high, true_low = self.nodes[true][1:3] if in_true == first else (true, true)
        false_high, false_low = self.nodes[false][1:3] if in_false == first else (false, false)
        if first == condition:
            return self.test(condition, true_high, false_low)
        high = self.test(condition, true_high, false_high)
        return self.test(first, high, self.test(condition, true_low, false_low))
