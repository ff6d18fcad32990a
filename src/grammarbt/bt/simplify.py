"""Smaller trees that behave alike.

Rules propose trees with fewer nodes: drop a child, put a child in its parent's place, join control nodes of one kind,
cancel double negation, use De Morgan's laws, take out what two neighbours have in common. What a rule proposes counts
only if the canonical form stays, so no rule needs to know when it is right.
"""

from __future__ import annotations

from heapq import heappop, heappush
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

from grammarbt.bt.canonical import all_pure, canonical_key
from grammarbt.bt.model import (
    Action,
    BehaviorTree,
    Condition,
    Fallback,
    Node,
    Not,
    Parallel,
    Sequence,
    children,
    walk,
    with_children,
)
from grammarbt.bt.notation import format_tree

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

PATIENCE = 30
"""Trees looked into, the smallest first, without finding a smaller one."""

Nodes: TypeAlias = tuple[Node, ...]


def simplify(tree: BehaviorTree, is_pure: Callable[[Condition], bool] = all_pure) -> BehaviorTree:
    """The smallest tree that the rules reach; it has the same canonical form.

    Args:
        tree: any tree.
        is_pure: whether a condition draws no randomness and changes only when an action runs.
    """
    key = canonical_key(tree, is_pure)
    best, seen, patience = _ranked(tree), {tree}, PATIENCE
    queue = [best]
    while queue and patience:
        smallest = heappop(queue)
        patience = PATIENCE if smallest[0] < best[0] else patience - 1
        best = min(best, smallest)
        for proposal in _proposals(smallest[2]):
            if proposal not in seen:
                seen.add(proposal)
                if canonical_key(proposal, is_pure) == key:
                    heappush(queue, _ranked(proposal))
    return best[2]


def size(tree: BehaviorTree) -> int:
    """Nodes of the tree."""
    return sum(1 for _ in walk(tree))


def _ranked(tree: BehaviorTree) -> tuple[int, str, BehaviorTree]:
    return size(tree), format_tree(tree), tree


def _proposals(tree: Node) -> Iterator[Node]:
    """The tree with one rule applied at one node; never larger."""
    yield from _rewritten(tree)
    parts = children(tree)
    for index, part in enumerate(parts):
        for proposal in _proposals(part):
            yield with_children(tree, (*parts[:index], proposal, *parts[index + 1 :]))


def _rewritten(node: Node) -> Iterator[Node]:
    if isinstance(node, Not):
        yield from _without_negation(node.child)
    elif not isinstance(node, Action | Condition):
        yield from node.children
        yield from _with_one_less(node)
        yield from _joined(node)
    if isinstance(node, Parallel):
        yield from (Fallback(node.children), Sequence(node.children))
    elif isinstance(node, Fallback | Sequence):
        yield from _with_common_part_taken_out(node)
        yield from _negated_whole(node)


def _without_negation(child: Node) -> Iterator[Node]:
    """Double negation, and De Morgan's law inwards."""
    if isinstance(child, Not):
        yield child.child
    if isinstance(child, Fallback | Sequence) and _negations(child) * 2 >= len(child.children) - 1:
        yield _dual(child, tuple(map(_negated, child.children)))


def _negated_whole(node: Fallback | Sequence) -> Iterator[Node]:
    """De Morgan's law outwards."""
    if _negations(node) * 2 > len(node.children):
        yield Not(_dual(node, tuple(map(_negated, node.children))))


def _with_one_less(node: Fallback | Sequence | Parallel) -> Iterator[Node]:
    parts = node.children
    for index in range(len(parts) if len(parts) > 1 else 0):
        rest = (*parts[:index], *parts[index + 1 :])
        if not isinstance(node, Parallel):
            yield type(node)(rest)
            continue
        yield from (Parallel(rest, wait) for wait in (node.successes - 1, node.successes) if 1 <= wait <= len(rest))


def _joined(node: Fallback | Sequence | Parallel) -> Iterator[Node]:
    for index, part in enumerate(node.children):
        if isinstance(part, Fallback | Sequence) and type(part) is type(node):
            yield with_children(node, (*node.children[:index], *part.children, *node.children[index + 1 :]))


def _with_common_part_taken_out(node: Fallback | Sequence) -> Iterator[Node]:
    """`?( →( c x ) →( c y ) )` as `→( c ?( x y ) )`, likewise at the end, and with `?` and `→` swapped."""
    for index, (left, right) in enumerate(pairwise(node.children)):
        if type(left) is not type(right) or not isinstance(left, Fallback | Sequence) or type(left) is type(node):
            continue
        ones, others = left.children, children(right)
        taken = []
        if ones[0] == others[0] and min(len(ones), len(others)) > 1:
            taken.append((ones[0], _both(node, ones[1:], others[1:])))
        if ones[-1] == others[-1] and min(len(ones), len(others)) > 1:
            taken.append((_both(node, ones[:-1], others[:-1]), ones[-1]))
        for parts in taken:
            yield with_children(node, (*node.children[:index], with_children(left, parts), *node.children[index + 2 :]))


def _both(node: Fallback | Sequence, ones: Nodes, others: Nodes) -> Node:
    return with_children(node, tuple(part[0] if len(part) == 1 else _dual(node, part) for part in (ones, others)))


def _negations(node: Fallback | Sequence) -> int:
    return sum(isinstance(part, Not) for part in node.children)


def _negated(node: Node) -> Node:
    return node.child if isinstance(node, Not) else Not(node)


def _dual(node: Fallback | Sequence, parts: Nodes) -> Node:
    return Sequence(parts) if isinstance(node, Fallback) else Fallback(parts)
