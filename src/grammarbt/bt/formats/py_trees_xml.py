"""The XML that py_trees 2.6 reads (`py_trees.parsers.behaviour_tree_xml`).

A leaf is a tag that the reader looks up in its registry of classes; its arguments are attributes, that is, ports or
constructor arguments of the class. Control nodes say `memory="false"`, since the reader's default is to remember.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.bt.formats.markup import quoted
from grammarbt.bt.formats.slug import slug, tags
from grammarbt.bt.formats.unique import UniqueNames
from grammarbt.bt.model import Action, BehaviorTree, Condition, Fallback, Leaf, Node, Not, Parallel, Sequence, children
from grammarbt.errors import FormatError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_TAGS = {Fallback: "Selector", Sequence: "Sequence", Not: "Inverter"}
_BUILT_IN = """root behaviortree subtree subtreeplus import include sequence selector fallback parallel condition count eternalguard
failureisrunning failureissuccess foreach inverter oneshot passthrough repeat retry runningisfailure runningissuccess
statustoblackboard successisfailure successisrunning timeout
"""
RESERVED = frozenset(_BUILT_IN.split())
"""Tags the reader has a meaning for, whatever their case."""

_KEYS = ("name", "behaviour_class_name", "child", "children")


def dumps(tree: BehaviorTree) -> str:
    """Write a tree.

    Raises:
        FormatError: the tree has a parallel node; the reader's stops only when all children have been ticked.
    """
    lines = ['<root main_tree_to_execute="MainTree">', '  <BehaviorTree ID="MainTree">']
    lines += _lines(tree, 2, tags(tree, RESERVED), UniqueNames())
    return "\n".join([*lines, "  </BehaviorTree>", "</root>"]) + "\n"


def _lines(node: Node, indent: int, names: Mapping[tuple[type[Leaf], str], str], unique: UniqueNames) -> Iterator[str]:
    space, name = "  " * indent, quoted(unique.name(node))
    if isinstance(node, Parallel):
        raise FormatError("py_trees' XML has no parallel node like ours", "convert to py_trees, its Python module")
    if isinstance(node, Action | Condition):
        yield f"{space}<{names[type(node), node.name]} name={name}{_attributes(node)}/>"
        return
    tag = _TAGS[type(node)]
    memory = "" if isinstance(node, Not) else ' memory="false"'
    yield f"{space}<{tag} name={name}{memory}>"
    for child in children(node):
        yield from _lines(child, indent + 1, names, unique)
    yield f"{space}</{tag}>"


def _attributes(leaf: Leaf) -> str:
    found = {slug(key, _KEYS): value for key, value in leaf.arguments}
    return "".join(f" {key}={quoted(value)}" for key, value in found.items())
