"""Mermaid flowcharts, which many wikis and forges draw."""

from __future__ import annotations

import re

from grammarbt.bt.model import Action, BehaviorTree, Condition, Node, Not, leaf_text, numbered
from grammarbt.bt.notation import operator

_SPECIAL = re.compile(r"[!-/:-@\[-^`{-~]")
"""ASCII punctuation but `_`: quotes end a label, and other signs are read as Markdown or HTML."""


def dumps(tree: BehaviorTree) -> str:
    """Write a tree as a flowchart from top to bottom whose nodes are n0, n1 … in pre-order."""
    nodes = numbered(tree)
    lines = [f"  n{number}{_look(node)}" for number, (node, _) in enumerate(nodes)]
    edges = [f"  n{parent} --- n{number}" for number, (_, parent) in enumerate(nodes) if parent is not None]
    return "\n".join(["flowchart TD", *lines, *edges]) + "\n"


def _look(node: Node) -> str:
    if isinstance(node, Action):
        return f'["{_escaped(leaf_text(node))}"]'
    if isinstance(node, Condition):
        return f'(["{_escaped(leaf_text(node))}"])'
    sign = _escaped(operator(node))
    return f'{{"{sign}"}}' if isinstance(node, Not) else f'["{sign}"]'


def _escaped(text: str) -> str:
    return _SPECIAL.sub(lambda found: f"#{ord(found.group())};", text)
