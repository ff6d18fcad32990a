"""The canonical form of a tree: equal keys mean equal behaviour.

Level one merges steps that go on alike. Level two, where conditions are pure – they draw no randomness and change only
when an action runs – reduces the conditions between two actions to ordered decision diagrams; then keys are equal
exactly when no sequence of condition values and action answers tells the trees apart.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.bt.bdd import DecisionGraph, GraphNode, TooLargeError
from grammarbt.bt.compiler import FAILURE, MAX_STEPS, RUNNING, SUCCESS, compile_steps
from grammarbt.bt.model import Action, BehaviorTree, Condition

if TYPE_CHECKING:
    from collections.abc import Callable

MAX_NODES = 1_000
"""Nodes of the largest reduced graph; conditions asked in unlucky orders can need exponentially many."""

MAX_CONDITIONS = 200
"""Distinct conditions up to which graphs are reduced; reducing goes as deep into the stack as there are conditions."""


def all_pure(_: Condition) -> bool:
    """Every condition changes only when an action runs."""
    return True


def none_pure(_: Condition) -> bool:
    """Any condition may change at any time: level one."""
    return False


def canonical_key(tree: BehaviorTree, is_pure: Callable[[Condition], bool] = all_pure) -> bytes:
    """The tree's canonical form; the same in every process.

    Args:
        tree: any tree.
        is_pure: whether a condition draws no randomness and changes only when an action runs.

    Raises:
        DomainError: nested parallel nodes need more than `MAX_STEPS` steps.
    """
    builder = GraphBuilder(is_pure, MAX_NODES)
    try:
        start = builder.start(tree)
    except TooLargeError:
        builder = GraphBuilder(none_pure, MAX_STEPS)
        start = builder.start(tree)
    return _serialise(builder.graph.nodes, start)


def behave_alike(one: BehaviorTree, other: BehaviorTree, is_pure: Callable[[Condition], bool] = all_pure) -> bool:
    """Whether the two trees have the same canonical form."""
    return canonical_key(one, is_pure) == canonical_key(other, is_pure)


class GraphBuilder:
    """Compiles trees into one decision graph, so that trees that behave alike start at the same node.

    Args:
        is_pure: whether a condition draws no randomness and changes only when an action runs.
        most_nodes: of the graph; beyond them `start` raises `TooLargeError`.

    Attributes:
        graph: of the trees so far.
    """

    def __init__(self, is_pure: Callable[[Condition], bool], most_nodes: int) -> None:
        self.graph = DecisionGraph(most_nodes)
        self._is_pure = is_pure
        self._pure: set[str] = set()

    def start(self, tree: BehaviorTree) -> int:
        """The node at which a tick of the tree starts."""
        steps = compile_steps(tree)
        nodes = [0] * len(steps.steps) + [RUNNING, FAILURE, SUCCESS]  # at -3, -2 and -1, as steps name the ends
        number, test, is_pure, pure = self.graph.number, self.graph.test, self._is_pure, self._pure
        for at, (leaf, _, success, failure, running) in enumerate(steps.steps):
            text = leaf.text
            if isinstance(leaf, Action):
                nodes[at] = number((text, nodes[success], nodes[failure], nodes[running]))
            elif is_pure(leaf):
                pure.add(text)
                if len(pure) > MAX_CONDITIONS:
                    raise TooLargeError
                nodes[at] = test(text, nodes[success], nodes[failure])
            else:
                nodes[at] = number((text, nodes[success], nodes[failure], RUNNING))
        return nodes[steps.first]


def _serialise(nodes: list[GraphNode], start: int) -> bytes:
    """A line for each node at the first visit, followed by what its answers lead to; its number from then on."""
    names = {SUCCESS: "S", FAILURE: "F", RUNNING: "R"}
    lines: list[str] = []
    stack = [start]
    while stack:
        at = stack.pop()
        while at not in names:
            names[at] = str(len(names))
            text, success, failure, running = nodes[at]
            lines.append(text)
            stack.append(failure)
            at = success
            if running != RUNNING:
                lines.append("+")
                stack.append(success)
                at = running
        lines.append(names[at])
    return "\n".join(lines).encode()
