"""The behavior tree: a frozen value made of control nodes, decorators and leaves.

The words are the field's (Colledanchise & Ögren, *Behavior Trees in Robotics and AI*, 2018): fallback, sequence and
parallel are control nodes, not is the decorator, actions and conditions are leaves.
"""

from __future__ import annotations

import re
from itertools import count
from reprlib import repr as shortened
from typing import TYPE_CHECKING, TypeAlias

from attrs import Attribute, field, frozen

from grammarbt.errors import NotationError

if TYPE_CHECKING:
    from collections.abc import Callable, Container, Iterator

MAX_DEPTH = 256
"""Levels of the deepest tree; BehaviorTree.CPP refuses more, and no reader gets lost in fewer."""

_FORBIDDEN = re.compile(r"[\[\](){}\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufffe\uffff]")
"""Signs of the notation, control characters, line separators, and what no UTF-8 or XML file can hold."""

Arguments: TypeAlias = tuple[tuple[str, str], ...]
"""A leaf's arguments: pairs of a name and a value, in the order in which they are written."""


def _check_name(_: object, attribute: Attribute[str], value: str) -> None:
    if not value or value != value.strip() or _FORBIDDEN.search(value):
        raise NotationError(
            f"a leaf cannot have the {attribute.name} {shortened(value)}",
            "names hold anything but brackets, parentheses, braces and control characters, with no space at the ends",
        )


def _check_arguments(_: object, __: Attribute[Arguments], value: Arguments) -> None:
    for key, text in value:
        for part in (key, text):
            if not part or part != part.strip() or _FORBIDDEN.search(part) or set(part) & set("=,"):
                raise NotationError(
                    f"{shortened(part)} cannot stand in a leaf's arguments", "write them as name(key=value)"
                )
    keys = [key for key, _ in value]
    if len(set(keys)) < len(keys):
        raise NotationError(f"a leaf's arguments name a key twice in {shortened(value)}", "give each key once")


@frozen(cache_hash=True)
class Action:
    """A leaf that acts; a tick answers success, failure or running.

    Attributes:
        name: of the action in the domain's vocabulary.
        arguments: what it is given, such as a place.
        text: the leaf in the one-line notation.
    """

    name: str = field(validator=_check_name)
    arguments: Arguments = field(default=(), validator=_check_arguments)
    text: str = field(init=False, repr=False, eq=False)

    @text.default
    def _text(self) -> str:
        return f"[{leaf_text(self)}]"


@frozen(cache_hash=True)
class Condition:
    """A leaf that asks; a tick answers success or failure. Its attributes are as an action's."""

    name: str = field(validator=_check_name)
    arguments: Arguments = field(default=(), validator=_check_arguments)
    text: str = field(init=False, repr=False, eq=False)

    @text.default
    def _text(self) -> str:
        return f"({leaf_text(self)})"


def _some(_: object, attribute: Attribute[tuple[Node, ...]], value: tuple[Node, ...]) -> None:
    if not value:
        raise NotationError(f"a control node needs {attribute.name}", "give it at least one child")


@frozen(cache_hash=True)
class Fallback:
    """Tries its children left to right until one does not fail."""

    children: tuple[Node, ...] = field(validator=_some)


@frozen(cache_hash=True)
class Sequence:
    """Runs its children left to right until one does not succeed."""

    children: tuple[Node, ...] = field(validator=_some)


def _reachable(node: Parallel, _: Attribute[int], value: int) -> None:
    if not 1 <= value <= len(node.children):
        raise NotationError(
            f"a parallel node of {len(node.children)} children cannot wait for {value} successes",
            "choose a number from 1 to the number of children",
        )


@frozen(cache_hash=True)
class Parallel:
    """Ticks its children left to right until `successes` of them succeed, or so many can no longer be reached.

    When all have been ticked and neither has happened, it is running.
    """

    children: tuple[Node, ...] = field(validator=_some)
    successes: int = field(validator=_reachable)


@frozen(cache_hash=True)
class Not:
    """Swaps its child's success and failure."""

    child: Node


Leaf: TypeAlias = Action | Condition
"""A node without children: it acts, or it asks."""

Control: TypeAlias = Fallback | Sequence | Parallel
"""A node that ticks several children."""

Node: TypeAlias = Control | Not | Leaf
"""Any node of a tree."""

BehaviorTree: TypeAlias = Node
"""A tree is its root node."""


def leaf_text(leaf: Leaf) -> str:
    """What stands between a leaf's brackets: its name, or `name(key=value)`."""
    if not leaf.arguments:
        return leaf.name
    return f"{leaf.name}({','.join(f'{key}={value}' for key, value in leaf.arguments)})"


def children(node: Node) -> tuple[Node, ...]:
    """The node's children, left to right; empty for a leaf."""
    if isinstance(node, Not):
        return (node.child,)
    return () if isinstance(node, Action | Condition) else node.children


def walk(tree: BehaviorTree) -> Iterator[Node]:
    """All nodes, each before its children, left to right."""
    stack: list[Node] = [tree]
    while stack:
        node = stack.pop()
        yield node
        stack.extend(reversed(children(node)))


def numbered(tree: BehaviorTree) -> list[tuple[Node, int | None]]:
    """All nodes in pre-order, each with its parent's place in that order; the root has None."""
    found: list[tuple[Node, int | None]] = []
    stack: list[tuple[Node, int | None]] = [(tree, None)]
    while stack:
        node, parent = stack.pop()
        stack += [(child, len(found)) for child in reversed(children(node))]
        found.append((node, parent))
    return found


def leaves(tree: BehaviorTree) -> tuple[Leaf, ...]:
    """All leaves, left to right; a leaf's place here is its *occurrence*."""
    return tuple(node for node in walk(tree) if isinstance(node, Action | Condition))


def depth(tree: BehaviorTree) -> int:
    """Nodes on the longest way from the root to a leaf; a single leaf has depth 1."""
    deepest, stack = 0, [(tree, 1)]
    while stack:
        node, level = stack.pop()
        deepest = max(deepest, level)
        stack.extend((child, level + 1) for child in children(node))
    return deepest


def with_children(node: Node, parts: tuple[Node, ...]) -> Node:
    """The node with other children; a parallel node never waits for more successes than it has children."""
    if isinstance(node, Not):
        return Not(parts[0])
    if isinstance(node, Action | Condition):
        return node
    if isinstance(node, Parallel):
        return Parallel(parts, min(node.successes, len(parts)))
    return type(node)(parts)


def rebuild(tree: BehaviorTree, change: Callable[[Node], Node]) -> BehaviorTree:
    """The tree with `change` applied to every node, children first."""
    return change(with_children(tree, tuple(rebuild(child, change) for child in children(tree))))


def without(tree: BehaviorTree, gone: Container[int]) -> BehaviorTree | None:
    """The tree without the nodes at some places in pre-order, and what is empty then; None when nothing is left."""
    places = count()

    def kept(node: Node) -> Node | None:
        place = next(places)
        parts = [kept(child) for child in children(node)]
        left = tuple(part for part in parts if part is not None)
        if place in gone or (parts and not left):
            return None
        return with_children(node, left)

    return kept(tree)
