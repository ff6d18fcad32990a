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
        self._tested: dict[tuple[str, int, int], int] = {}

    def call(self, leaf: str, success: int, failure: int, running: int) -> int:
        """The node that ticks `leaf`."""
        key = (leaf, success, failure, running)
        at = self._known.get(key)
        if at is None:
            at = self._known[key] = len(self.nodes)
            if at >= self._most_nodes:
                raise TooLargeError
            self.nodes.append(key)
        return at

    def test(self, condition: str, true: int, false: int) -> int:
        """The node that behaves like `true` where the condition holds and like `false` where not."""
        if true == false:
            return true
        key = (condition, true, false)
        at = self._tested.get(key)
        if at is None:
            at = self._tested[key] = self._test(condition, true, false)
        return at

    def _test(self, condition: str, true: int, false: int) -> int:
        tests = self.tests
        in_true, in_false = tests.get(true), tests.get(false)
        first = condition
        if in_true is not None and in_true < first:
            first = in_true
        if in_false is not None and in_false < first:
            first = in_false
        if first == condition:
            high = self.nodes[true][1] if in_true == first else true
            low = self.nodes[false][2] if in_false == first else false
        else:
            true_high, true_low = self.nodes[true][1:3] if in_true == first else (true, true)
            false_high, false_low = self.nodes[false][1:3] if in_false == first else (false, false)
            high = self.test(condition, true_high, false_high)
            low = self.test(condition, true_low, false_low)
        if high == low:
            return high
        at = self.call(first, high, low, RUNNING)
        tests[at] = first
        return at
