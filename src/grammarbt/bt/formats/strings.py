"""The string lists of Styrud, Iovino and colleagues.

As in Iovino et al., *Learning Behavior Trees with Genetic Programming in Unpredictable Environments*, ICRA 2021:

    ["f(", "task done?", "s(", "localise!", "pick!", ")", ")"]

`f(` fallback, `s(` sequence, `p2(` parallel with two successes (`p(` all), `n(` not, `)` up; a condition ends with `?`,
an action with `!` or, when read, with nothing.
"""

from __future__ import annotations

import ast
import json
import re

from grammarbt.bt.formats.building import check_level, control_node, leaf_node
from grammarbt.bt.model import Action, BehaviorTree, Condition, Node, Not, Parallel, Sequence, leaf_text
from grammarbt.errors import FormatError

_STRING = re.compile(r"""'(?:[^'\\\n]|\\.)*'|"(?:[^"\\\n]|\\.)*\"""")
_BETWEEN = re.compile(r"[\s,]*")
_OPENING = re.compile(r"[fsn]\(|p(\d{0,9})\(")


def dumps(tree: BehaviorTree) -> str:
    """Write a tree as a list of strings, which Python and JSON read alike."""
    return json.dumps(_encode(tree), ensure_ascii=False) + "\n"


def loads(text: str) -> BehaviorTree:
    """Read a tree from a list of strings in Python's or JSON's spelling.

    Raises:
        FormatError: the list is no tree; the message counts strings from 1.
    """
    signs: list[str] = []
    parts: list[list[Node]] = [[]]
    for number, string in enumerate(_strings(text), start=1):
        place = f"at string {number}"
        if parts[0] and not signs:
            raise FormatError(f"the list goes on after the tree, {place}", "remove the rest")
        check_level(len(parts), place)
        opening = _OPENING.fullmatch(string)
        if opening:
            signs.append(string)
            parts.append([])
        elif string == ")":
            if not signs:
                raise FormatError(f"nothing is open that ')' could close, {place}", "remove it")
            inside = parts.pop()
            parts[-1].append(control_node(_sign(signs.pop(), inside), inside, place))
        else:
            parts[-1].append(_leaf(string, place))
    if signs or not parts[0]:
        raise FormatError(f"the list ends with {len(signs)} nodes open", "add ')' for each control node")
    return parts[0][0]


def _encode(node: Node) -> list[str]:
    if isinstance(node, Action | Condition):
        return [leaf_text(node) + ("!" if isinstance(node, Action) else "?")]
    if isinstance(node, Not):
        return ["n(", *_encode(node.child), ")"]
    letter = f"p{node.successes}" if isinstance(node, Parallel) else "s" if isinstance(node, Sequence) else "f"
    return [f"{letter}(", *(text for child in node.children for text in _encode(child)), ")"]


def _strings(text: str) -> list[str]:
    inside = text.strip()
    if not (inside.startswith("[") and inside.endswith("]")):
        raise FormatError("not a list of strings: it must start with '[' and end with ']'", "compare an export")
    strings, at, end = [], 1, len(inside) - 1
    while (at := _space(inside, at)) < end:
        found = _STRING.match(inside, at, end)
        if found is None:
            raise FormatError(f"not a list of strings, at character {at + 1} near {inside[at : at + 20]!r}", "quote it")
        strings.append(_unquoted(found.group()))
        at = found.end()
    return strings


def _space(text: str, at: int) -> int:
    found = _BETWEEN.match(text, at)
    return found.end() if found else at


def _unquoted(literal: str) -> str:
    try:
        return str(ast.literal_eval(literal))
    except (SyntaxError, ValueError):
        raise FormatError(f"not a string: {literal[:20]}", "compare an export") from None


def _sign(opening: str, inside: list[Node]) -> str:
    if opening.startswith("p"):
        return f"‖{opening[1:-1] or len(inside)}"
    return {"f(": "?", "s(": "→", "n(": "!"}[opening]


def _leaf(string: str, place: str) -> Node:
    kind = Condition if string.endswith("?") else Action
    return leaf_node(kind, string[:-1] if string.endswith(("?", "!")) else string, place)
