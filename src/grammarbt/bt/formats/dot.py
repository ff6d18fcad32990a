"""Graphviz DOT; boxes are actions, ellipses conditions, as in the paper's figures."""

from __future__ import annotations

from grammarbt.bt.model import Action, BehaviorTree, Condition, Node, Not, leaf_text, numbered
from grammarbt.bt.notation import operator

_HEAD = ["digraph tree {", "  ordering=out", '  node [fontname="sans-serif"]', "  edge [arrowhead=none]"]


def dumps(tree: BehaviorTree) -> str:
    """Write a tree as a directed graph whose nodes are n0, n1 … in pre-order."""
    nodes = numbered(tree)
    lines = [f"  n{number} [{_look(node)}]" for number, (node, _) in enumerate(nodes)]
    edges = [f"  n{parent} -> n{number}" for number, (_, parent) in enumerate(nodes) if parent is not None]
    return "\n".join([*_HEAD, *lines, *edges, "}"]) + "\n"


def _look(node: Node) -> str:
    if isinstance(node, Action | Condition):
        shape = "box" if isinstance(node, Action) else "ellipse"
        return f'shape={shape} label="{_escaped(leaf_text(node))}"'
    shape = "diamond" if isinstance(node, Not) else "square"
    return f'shape={shape} label="{operator(node)}"'


def _escaped(text: str) -> str:
    """Graphviz gives a meaning to backslashes, quotes, and to entities as in HTML."""
    return text.replace("\\", "\\\\").replace('"', '\\"').replace("&", "&amp;")
