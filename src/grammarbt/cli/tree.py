"""`grammarbt tree`: look at trees."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from grammarbt.bt import Action, BehaviorTree, Condition, Node, children, format_leaf
from grammarbt.bt.notation import operator
from grammarbt.cli.app import open_registry
from grammarbt.run.trees import load_tree

if TYPE_CHECKING:
    from collections.abc import Iterator


@click.group("tree", context_settings={"help_option_names": ["-h", "--help"]})
def command() -> None:
    """Look at trees."""


@command.command("show")
@click.argument("tree")
def show(tree: str) -> None:
    """Draw TREE, a node a line: notation, a file, or a run folder."""
    print(drawing(load_tree(tree, open_registry())))


def drawing(tree: BehaviorTree) -> str:
    """The tree with branches down the left side."""
    return "\n".join([_label(tree), *_branches(tree, "")])


def _branches(node: Node, indent: str) -> Iterator[str]:
    parts = children(node)
    for number, part in enumerate(parts, 1):
        branch, below = ("└─ ", "   ") if number == len(parts) else ("├─ ", "│  ")
        yield f"{indent}{branch}{_label(part)}"
        yield from _branches(part, indent + below)


def _label(node: Node) -> str:
    return format_leaf(node) if isinstance(node, Action | Condition) else operator(node)
