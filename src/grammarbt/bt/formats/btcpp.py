"""BehaviorTree.CPP, XML of version 4.

Reactive control nodes tick from the first child every time, as ours do; `<Sequence>` and `<Fallback>` go on where they
were and so are refused. Leaves are compact tags, since `<Action ID="…"/>` straight under a reactive node is refused by
4.8 and later; `name` keeps the leaf as it stands in the notation, arguments included. An argument `x` also is the
attribute `_arg_x`: the library refuses attributes that are neither ports nor begin with `_`, and gives some of those,
like `_while`, a meaning.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from grammarbt.bt.formats.building import check_level, control_node, leaf_node
from grammarbt.bt.formats.markup import Element, quoted, read_xml
from grammarbt.bt.formats.slug import is_tag_of, slug, tags
from grammarbt.bt.model import (
    Action,
    BehaviorTree,
    Condition,
    Fallback,
    Leaf,
    Node,
    Not,
    Parallel,
    Sequence,
    depth,
    leaf_text,
)
from grammarbt.bt.notation import read_leaf
from grammarbt.errors import FormatError, NotationError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

__all__ = ["dumps", "loads"]

CONTROL = {"ReactiveFallback": "?", "ReactiveSequence": "→", "Inverter": "!", "Parallel": "‖"}
_TAGS = {Fallback: "ReactiveFallback", Sequence: "ReactiveSequence", Not: "Inverter"}
_REMEMBERING = ("Sequence", "Fallback", "SequenceWithMemory", "AsyncSequence", "AsyncFallback")
_KINDS: dict[str, type[Action | Condition]] = {"Action": Action, "Condition": Condition}
_NUMBER = re.compile(r"-?\d{1,9}")

_BUILT_IN = """root BehaviorTree TreeNodesModel include Action Condition Control Decorator SubTree SubTreePlus
Fallback AsyncFallback Sequence AsyncSequence SequenceWithMemory SequenceStar Parallel ParallelAll ReactiveSequence
ReactiveFallback IfThenElse WhileDoElse TryCatch ManualSelector Switch2 Switch3 Switch4 Switch5 Switch6
Inverter RetryUntilSuccessful RetryUntilSuccesful KeepRunningUntilFailure Repeat Timeout Delay RunOnce
ForceSuccess ForceFailure LoopInt LoopBool LoopDouble LoopString LoopAny Precondition SkipUnlessUpdated
WaitValueUpdate EntryUpdated UpdatedDecorator AlwaysSuccess AlwaysFailure Script ScriptCondition SetBlackboard
UnsetBlackboard Sleep WasEntryUpdated ConsumeQueue PopFromQueue QueueSize TestNode
"""
RESERVED = frozenset(_BUILT_IN.lower().split())
"""Tags the library has a meaning for, in lower case."""


def dumps(tree: BehaviorTree) -> str:
    """Write a tree, with the model of its leaves.

    Raises:
        FormatError: the tree is deeper than the library allows.
    """
    check_level(depth(tree), "which is as deep as BehaviorTree.CPP reads")
    names = tags(tree, RESERVED)
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        '<root BTCPP_format="4" main_tree_to_execute="MainTree">',
        '  <BehaviorTree ID="MainTree">',
        *_lines(tree, 2, names),
        "  </BehaviorTree>",
        "  <TreeNodesModel>",
        *(f"    <{kind.__name__} ID={quoted(tag)}/>" for (kind, _), tag in names.items()),
        "  </TreeNodesModel>",
        "</root>",
    ]
    return "\n".join(lines) + "\n"


def loads(text: str) -> BehaviorTree:
    """Read a tree.

    Raises:
        FormatError: not such XML, or nodes that mean something else than ours; the message names the line.
    """
    root = read_xml(text)
    if root.tag != "root" or root.attributes.get("BTCPP_format") != "4":
        raise FormatError('not XML of BehaviorTree.CPP 4: no <root BTCPP_format="4">', "check the file's version")
    main = _main_tree(root)
    if len(main.children) != 1:
        raise FormatError(
            f"a tree has one root, not {len(main.children)}, {main.place}", "put a ReactiveFallback above"
        )
    return _Reader(_declared(root)).node(main.children[0], 1)


def _lines(node: Node, indent: int, names: Mapping[tuple[type[Leaf], str], str]) -> Iterator[str]:
    space = "  " * indent
    if isinstance(node, Action | Condition):
        yield f"{space}<{names[type(node), node.name]} name={quoted(leaf_text(node))}{_extra(node)}/>"
        return
    tag = "Parallel" if isinstance(node, Parallel) else _TAGS[type(node)]
    parts = (node.child,) if isinstance(node, Not) else node.children
    counts = ""
    if isinstance(node, Parallel):  # fail exactly when too few children are left to succeed
        counts = f' success_count="{node.successes}" failure_count="{len(parts) - node.successes + 1}"'
    yield f"{space}<{tag}{counts}>"
    for part in parts:
        yield from _lines(part, indent + 1, names)
    yield f"{space}</{tag}>"


def _extra(leaf: Leaf) -> str:
    taken: dict[str, str] = {}
    for key, value in leaf.arguments:
        taken.setdefault(f"_arg_{slug(key)}", value)
    return "".join(f" {key}={quoted(value)}" for key, value in taken.items())


def _main_tree(root: Element) -> Element:
    trees = [element for element in root.children if element.tag == "BehaviorTree"]
    wanted = root.attributes.get("main_tree_to_execute")
    chosen = [tree for tree in trees if wanted is None or tree.attributes.get("ID") == wanted]
    if len(chosen) != 1:
        raise FormatError(
            f"cannot tell which of {len(trees)} <BehaviorTree> is meant", "name it in main_tree_to_execute"
        )
    return chosen[0]


def _declared(root: Element) -> dict[str, type[Action | Condition]]:
    models = [model for element in root.children if element.tag == "TreeNodesModel" for model in element.children]
    return {model.attributes.get("ID", ""): _KINDS[model.tag] for model in models if model.tag in _KINDS}


class _Reader:
    def __init__(self, declared: Mapping[str, type[Action | Condition]]) -> None:
        self.declared = declared

    def node(self, element: Element, level: int) -> Node:
        check_level(level, element.place)
        sign = CONTROL.get(element.tag)
        if sign is None:
            return self.leaf(element)
        parts = [self.node(child, level + 1) for child in element.children]
        if element.tag == "Parallel":
            sign += str(_successes(element, len(parts)))
        return control_node(sign, parts, element.place)

    def leaf(self, element: Element) -> Leaf:
        explicit = element.tag in _KINDS
        tag = element.attributes.get("ID", "") if explicit else element.tag
        kind = _KINDS[element.tag] if explicit else self.declared.get(tag)
        if element.tag in _REMEMBERING:
            raise FormatError(
                f"a {tag} goes on where it was, {element.place}", "use ReactiveSequence or ReactiveFallback"
            )
        if kind is None or element.children:
            raise FormatError(
                f"neither a known node nor a declared leaf, {element.place}",
                "declare actions and conditions in <TreeNodesModel>; other nodes have no counterpart",
            )
        return leaf_node(kind, _leaf_text(tag, element.attributes), element.place)


def _leaf_text(tag: str, attributes: Mapping[str, str]) -> str:
    """The leaf in notation: from `name` where we wrote it, else from the tag and the ports."""
    name = attributes.get("name", "")
    try:
        if is_tag_of(tag, read_leaf(name, Action).name, RESERVED):
            return name
    except NotationError:
        pass  # a name given by hand
    ports = [f"{key}={value}" for key, value in attributes.items() if key not in ("name", "ID") and key[0] != "_"]
    return f"{tag}({','.join(ports)})" if ports else tag


def _successes(element: Element, children: int) -> int:
    """M of a parallel node, which must fail exactly when M successes can no longer be reached."""
    counts = [_count(element, "success_count", "-1", children), _count(element, "failure_count", "1", children)]
    if counts[0] + counts[1] <= children:
        raise FormatError(
            f"fails before {counts[0]} successes are out of reach, {element.place}",
            f'set failure_count="{children - counts[0] + 1}"',
        )
    return counts[0]


def _count(element: Element, attribute: str, default: str, children: int) -> int:
    value = element.attributes.get(attribute, default)
    if not _NUMBER.fullmatch(value):
        raise FormatError(f"{attribute} is not a number, {element.place}", "write a number")
    return int(value) if int(value) >= 0 else max(children + int(value) + 1, 0)
