"""Indented trees, a node a line.

Both common dialects are read: tabs (or spaces) with `<!>` decorators, `|| 2` parallels and `{x}` suffixes, as in the
`behavior_tree` package for ROS; and bars with `!(c)`, `=2` and `;;` comments, as in the `behavior_tree` viewer. Written
are tabs. A suffix becomes the argument `id`.
"""

from __future__ import annotations

import re

from attrs import define, field

from grammarbt.bt.formats.building import check_level, control_node, leaf_node
from grammarbt.bt.model import Action, BehaviorTree, Condition, Node, Not, Parallel, Sequence
from grammarbt.bt.notation import format_leaf, parse
from grammarbt.errors import FormatError

_ONE_LINE = re.compile(r"(?:\?|→|->|(?:‖|\|\|)\d+)[ \t]*\(")
_PARALLEL = re.compile(r"(?:\|\||‖|=)\s*(\d+)")
_CONTROL = re.compile(r"\?|->|→|<!>")
_LEAF = re.compile(r"(!*)\s*(?:\[([^\[\]]*)\]|\(([^()]*(?:\([^()]*\)[^()]*)?)\))\s*(\{[^{}]*\})?")
_SIGNS = {"->": "→", "<!>": "!"}


def dumps(tree: BehaviorTree) -> str:
    """Write a tree, indented by tabs."""
    lines: list[str] = []
    stack: list[tuple[Node, int]] = [(tree, 0)]
    while stack:
        node, level = stack.pop()
        lines.append("\t" * level + _label(node))
        parts = (node.child,) if isinstance(node, Not) else getattr(node, "children", ())
        stack += [(part, level + 1) for part in reversed(parts)]
    return "\n".join(lines) + "\n"


def loads(text: str) -> BehaviorTree:
    """Read a tree in either dialect, or in the one-line notation.

    Raises:
        FormatError: the text is no tree; the message names the line.
        NotationError: the same, of a tree in the one-line notation.
    """
    if _ONE_LINE.match(text.lstrip()):
        return parse(text.strip())
    builder = _Builder()
    for number, line in enumerate(text.split("\n"), start=1):
        width, content = _indentation(line.rstrip("\r"))
        if content and not content.startswith(";;"):
            builder.add(width, content, f"line {number}")
    return builder.tree()


def _label(node: Node) -> str:
    if isinstance(node, Action | Condition):
        return format_leaf(node)
    if isinstance(node, Parallel):
        return f"|| {node.successes}"
    return "<!>" if isinstance(node, Not) else "->" if isinstance(node, Sequence) else "?"


def _indentation(line: str) -> tuple[int, str]:
    """How far a line is indented, in bars or else in white space, and what stands there."""
    bars, rest = 0, line.lstrip(" \t")
    width = len(line.expandtabs(4)) - len(line.lstrip(" \t").expandtabs(4))
    while rest.startswith("|") and not _PARALLEL.match(rest):
        bars, rest = bars + 1, rest[1:].lstrip(" \t")
    return bars or width, rest.rstrip()


@define
class _Open:
    """A control node whose children are still coming; `sign` is None for a leaf, which has none."""

    width: int
    sign: str | None
    place: str
    negations: int = 0
    parts: list[Node] = field(factory=list)
    inner_width: int | None = None

    def check_child(self, width: int, place: str) -> None:
        if self.sign is None:
            raise FormatError(f"an action or condition has no children, {place}", "indent the line less")
        if self.inner_width not in (None, width):
            raise FormatError(f"the line is indented unlike its siblings, {place}", "indent siblings alike")
        self.inner_width = width

    def close(self) -> Node:
        node = self.parts[0] if self.sign is None else control_node(self.sign, self.parts, self.place)
        for _ in range(self.negations):
            node = Not(node)
        return node


class _Builder:
    def __init__(self) -> None:
        self.open: list[_Open] = []
        self.root: Node | None = None

    def add(self, width: int, content: str, place: str) -> None:
        while self.open and self.open[-1].width >= width:
            self.close_last()
        if self.root is not None:
            raise FormatError(f"a second tree starts, {place}", "put a fallback or sequence above both")
        if self.open:
            self.open[-1].check_child(width, place)
        node = _read_node(width, content, place)
        check_level(len(self.open) + 1 + node.negations, place)
        self.open.append(node)

    def close_last(self) -> None:
        closed = self.open.pop().close()
        if self.open:
            self.open[-1].parts.append(closed)
        else:
            self.root = closed

    def tree(self) -> Node:
        while self.open:
            self.close_last()
        if self.root is None:
            raise FormatError("there is no tree in the text", "write one node a line")
        return self.root


def _read_node(width: int, content: str, place: str) -> _Open:
    parallel = _PARALLEL.match(content)
    found = parallel or _CONTROL.match(content) or _LEAF.match(content)
    if found is None:
        raise FormatError(
            f"not a node: {content[:30]!r}, {place}", "a line is ?, ->, <!>, || 2, =2, [action] or (condition)"
        )
    rest = content[found.end() :].strip()
    if rest and not rest.startswith(";;"):
        raise FormatError(f"a line holds one node; {rest[:30]!r} goes on, {place}", "begin a new line")
    if parallel:
        return _Open(width, f"‖{parallel.group(1)[:9]}", place)
    if found.re is _CONTROL:
        return _Open(width, _SIGNS.get(found.group(), found.group()), place)
    return _read_leaf(width, found, place)


def _read_leaf(width: int, found: re.Match[str], place: str) -> _Open:
    negations, action, condition, outside = found.groups()
    text = _standard_arguments((condition if action is None else action).strip() + (outside or ""))
    leaf = leaf_node(Condition if action is None else Action, text, place)
    return _Open(width, None, place, len(negations), [leaf])


def _standard_arguments(text: str) -> str:
    """`name {x}` as `name(id=x)`, and `name(x: y)`, as planners write it, as `name(x=y)`."""
    if text.endswith("}"):
        name, _, suffix = text[:-1].rpartition("{")
        return f"{name.rstrip()}(id={suffix})"
    name, opening, arguments = text.partition("(")
    return text if "=" in arguments else name + opening + arguments.replace(":", "=")
