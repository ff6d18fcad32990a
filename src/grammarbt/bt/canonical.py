"""The canonical form of a tree: equal keys mean equal behaviour.

Level one merges steps that go on alike. Level two, where conditions are pure – they draw no randomness and change only
when an action runs – reduces the conditions between two actions to ordered decision diagrams; then keys are equal
exactly when no sequence of condition values and action answers tells the trees apart.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from grammarbt.bt.bdd import DecisionGraph, GraphNode, TooLargeError
from grammarbt.bt.compiler import FAILURE, RUNNING, SUCCESS, Compiler, visit_order
from grammarbt.bt.model import BehaviorTree, Condition, Leaf
from grammarbt.bt.notation import format_leaf
from grammarbt.errors import DomainError

if TYPE_CHECKING:
    from collections.abc import Callable

MAX_NODES = 1_000
"""Nodes of the largest reduced graph; conditions asked in unlucky orders can need exponentially many."""

MAX_LEVEL_ONE_NODES = 100_000
MAX_CONDITIONS = 200
"""Distinct conditions up to which graphs are reduced; reducing goes as deep into the stack as there are conditions."""

_text = lru_cache(maxsize=65_536)(format_leaf)


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
        DomainError: nested parallel nodes need more than `MAX_LEVEL_ONE_NODES` nodes.
    """
    builder = GraphBuilder(is_pure, MAX_NODES)
    try:
        start = builder.start(tree)
    except TooLargeError:
        builder = GraphBuilder(none_pure, MAX_LEVEL_ONE_NODES)
        start = _level_one(builder, tree)
    return _serialise(builder.graph.nodes, start)


def behave_alike(one: BehaviorTree, other: BehaviorTree, is_pure: Callable[[Condition], bool] = all_pure) -> bool:
    """Whether the two trees have the same canonical form."""
    return canonical_key(one, is_pure) == canonical_key(other, is_pure)


class GraphBuilder(Compiler):
    """Compiles trees into one decision graph, so that trees that behave alike start at the same node."""

    def __init__(self, is_pure: Callable[[Condition], bool], most_nodes: int) -> None:
        super().__init__()
        self.graph = DecisionGraph(most_nodes)
        self._is_pure = is_pure
        self._pure: set[str] = set()

    def leaf(self, leaf: Leaf, success: int, failure: int, running: int) -> int:
        """A test for a pure condition, a call for everything else."""
        text = _text(leaf)
        if not isinstance(leaf, Condition):
            return self.graph.call(text, success, failure, running)
        if not self._is_pure(leaf):
            return self.graph.call(text, success, failure, RUNNING)
        self._pure.add(text)
        if len(self._pure) > MAX_CONDITIONS:
            raise TooLargeError
        return self.graph.test(text, success, failure)


def _level_one(builder: GraphBuilder, tree: BehaviorTree) -> int:
    try:
        return builder.start(tree)
    except TooLargeError:
        raise DomainError(
            f"the tree's parallel nodes unroll to more than {MAX_LEVEL_ONE_NODES:,} steps", "nest fewer of them"
        ) from None


def _serialise(nodes: list[GraphNode], start: int) -> bytes:
    """One line a node, in the order of first visit; names hold no control characters, so nothing is ambiguous."""
    order = visit_order(nodes, start)
    new = {**order, SUCCESS: "S", FAILURE: "F", RUNNING: "R"}
    lines = [new[start]]
    for at in order:
        text, success, failure, running = nodes[at]
        lines.append(f"{text}\t{new[success]}\t{new[failure]}\t{new[running]}")
    return "\n".join(map(str, lines)).encode()
