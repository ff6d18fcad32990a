"""Acyclic graphs whose paths spell each word, or each derivation, of a language exactly once."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from typing import TypeAlias, TypeVar

from attrs import frozen

from grammarbt.errors import GrammarError

MAX_NODES = 300_000
"""Nodes of the largest graph."""

MAX_STEPS = 200_000
"""Moves looked at, at most, for all graphs of a language together; some tens of microseconds each."""

Edge: TypeAlias = tuple[int, int]
"""A label and the node it leads to. A label is a terminal, or a production, or, as `~block`, a whole block."""


_Key = TypeVar("_Key")


class InfiniteLanguageError(GrammarError):
    """There is no largest tree, so nothing can be counted or drawn uniformly."""


class TooLargeError(GrammarError):
    """Working on the language exactly would take more than the stated limits."""


@frozen
class Paths:
    """An acyclic graph that begins at node 0.

    Attributes:
        edges: each node's edges, by label.
        final: whether a path may end at the node.
        order: the nodes, each after all that its edges lead to.
    """

    edges: tuple[tuple[Edge, ...], ...]
    final: tuple[bool, ...]
    order: tuple[int, ...]


def explore(start: _Key, edges: Callable[[_Key], tuple[bool, list[tuple[int, _Key]]]]) -> Paths:
    """The graph that `edges` spans, breadth-first so that endless growth is met while things are small."""
    number, queue = {start: 0}, deque([start])
    table: list[tuple[Edge, ...]] = []
    final: list[bool] = []
    while queue:
        end, own = edges(queue.popleft())
        for _, after in own:
            if after not in number:
                number[after] = len(number)
                queue.append(after)
        if len(number) > MAX_NODES:
            raise too_large()
        final.append(end)
        table.append(tuple((label, number[after]) for label, after in own))
    return Paths(tuple(table), tuple(final), _children_first(table))


def _children_first(edges: Sequence[Sequence[Edge]]) -> tuple[int, ...]:
    waiting = [len(own) for own in edges]
    parents: list[list[int]] = [[] for _ in edges]
    for node, own in enumerate(edges):
        for _, after in own:
            parents[after].append(node)
    order = [node for node, count in enumerate(waiting) if not count]
    for node in order:
        for parent in parents[node]:
            waiting[parent] -= 1
            if not waiting[parent]:
                order.append(parent)
    if len(order) < len(edges):
        raise infinite()
    return tuple(order)


def infinite() -> InfiniteLanguageError:
    """The error for a language that has no largest tree."""
    return InfiniteLanguageError(
        "the language has infinitely many trees", "limit them, for example with `%limit nodes 40`"
    )


def too_large() -> TooLargeError:
    """The error for a language that passes the limits."""
    message = f"the language is too large: its graph passes {MAX_NODES:,} nodes or {MAX_STEPS:,} steps"
    return TooLargeError(message, "use fewer groups or leaves, or a smaller %limit")
