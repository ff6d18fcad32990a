"""A tree on the terminal: a node a line, with branches down the left side."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.bt import Action, BehaviorTree, Condition, Node, children, format_leaf
from grammarbt.bt.notation import operator

if TYPE_CHECKING:
    from collections.abc import Iterator


def drawing(tree: BehaviorTree) -> list[str]:
    """One line for each node, in pre-order."""
    return [label(tree), *_branches(tree, "")]


def label(node: Node) -> str:
    """What stands in the node: a leaf in notation, or the operator."""
    return format_leaf(node) if isinstance(node, Action | Condition) else operator(node)


def _branches(node: Node, indent: str) -> Iterator[str]:
    parts = children(node)
    for number, part in enumerate(parts, 1):
        branch, below = ("└─ ", "   ") if number == len(parts) else ("├─ ", "│  ")
        yield f"{indent}{branch}{label(part)}"
        yield from _branches(part, indent + below)
