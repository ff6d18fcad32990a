"""Trees as JSON.

A tree is ``{"grammarbt": 1, "tree": NODE}``. A NODE has a ``"type"``: fallback, sequence and parallel have
``"children"``, parallel also ``"successes"``; not has a ``"child"``; action and condition have a ``"name"`` and, if any,
``"arguments"``, an object of strings.
"""

from __future__ import annotations

import json
from typing import Any

from grammarbt.bt.formats.building import check_level, control_node
from grammarbt.bt.model import MAX_DEPTH, Action, BehaviorTree, Condition, Fallback, Node, Not, Parallel, Sequence
from grammarbt.errors import FormatError, NotationError

VERSION = 1
_TYPES = {Fallback: "fallback", Sequence: "sequence", Parallel: "parallel", Action: "action", Condition: "condition"}
_SIGNS = {"fallback": "?", "sequence": "→", "not": "!"}


def dumps(tree: BehaviorTree) -> str:
    """Write a tree as JSON."""
    return json.dumps({"grammarbt": VERSION, "tree": _encode(tree)}, ensure_ascii=False, indent=2) + "\n"


def loads(text: str) -> BehaviorTree:
    """Read a tree.

    Raises:
        FormatError: the text is not JSON, or not a tree; the message names the path to the place.
    """
    try:
        data = json.loads(text)
    except json.JSONDecodeError as error:
        raise FormatError(
            f"not JSON: {error.msg}, line {error.lineno} column {error.colno}", "compare an export"
        ) from None
    except RecursionError:
        raise FormatError(
            f"the JSON is nested deeper than a tree of {MAX_DEPTH} levels", "no tree needs that"
        ) from None
    except ValueError as error:
        raise FormatError(f"not a tree in JSON: {error}", "compare an export") from None
    if not isinstance(data, dict) or data.get("grammarbt") != VERSION:
        raise FormatError(f'not a tree in JSON: no "grammarbt": {VERSION} at the top', "compare an export")
    return _decode(data.get("tree"), "tree", 1)


def _encode(node: Node) -> dict[str, Any]:
    if isinstance(node, Not):
        return {"type": "not", "child": _encode(node.child)}
    encoded: dict[str, Any] = {"type": _TYPES[type(node)]}
    if isinstance(node, Action | Condition):
        encoded["name"] = node.name
        return encoded | ({"arguments": dict(node.arguments)} if node.arguments else {})
    if isinstance(node, Parallel):
        encoded["successes"] = node.successes
    return encoded | {"children": [_encode(child) for child in node.children]}


def _decode(data: object, path: str, level: int) -> Node:
    check_level(level, f"at {path[:80]}")
    if not isinstance(data, dict):
        raise _error(path, "is not an object")
    kind = data.get("type")
    if kind in ("action", "condition"):
        return _decode_leaf(Action if kind == "action" else Condition, data, path)
    if kind == "not":
        return Not(_decode(data.get("child"), f"{path}.child", level + 1))
    children = data.get("children")
    if not isinstance(children, list):
        raise _error(path, 'has no known "type" with its "children"')
    parts = [_decode(child, f"{path}.children[{index}]", level + 1) for index, child in enumerate(children)]
    return control_node(_sign(kind, data, path), parts, f"at {path}")


def _sign(kind: object, data: dict[str, object], path: str) -> str:
    successes = data.get("successes")
    if kind == "parallel" and type(successes) is int and successes > 0:
        return f"‖{successes}"
    if not isinstance(kind, str) or kind not in _SIGNS:
        raise _error(path, 'has no known "type", or is parallel without a number of "successes"')
    return _SIGNS[kind]


def _decode_leaf(kind: type[Action | Condition], data: dict[str, object], path: str) -> Node:
    name, arguments = data.get("name"), data.get("arguments", {})
    if not isinstance(name, str) or not isinstance(arguments, dict):
        raise _error(path, 'needs a "name", and "arguments" that are an object')
    if not all(isinstance(value, str) for value in arguments.values()):
        raise _error(path, "has an argument that is not a string")
    try:
        return kind(name, tuple(arguments.items()))
    except NotationError as error:
        raise FormatError(f"{error.message}, at {path}", error.hint) from None


def _error(path: str, message: str) -> FormatError:
    return FormatError(f"{path} {message}", "compare an export")
