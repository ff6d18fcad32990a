"""The paper's one-line notation, both ways.

    ?( →( (mine found) (is armed) [disarm] ) →( !(carrying object) [pick up] ) [random walk] )

`?` fallback, `→` or `->` sequence, `!` not, `‖2` or `||2` parallel, `[…]` action, `(…)` condition. White space between
tokens is free. After `!`, `(c)` and `((c))` read alike.
"""

from __future__ import annotations

import re
from reprlib import repr as shortened
from typing import TYPE_CHECKING, Any, TypeAlias

from attrs import frozen

from grammarbt.bt.model import (
    MAX_DEPTH,
    Action,
    Arguments,
    BehaviorTree,
    Condition,
    Control,
    Fallback,
    Leaf,
    Node,
    Not,
    Parallel,
    Sequence,
)
from grammarbt.errors import NotationError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

_OPERATOR = re.compile(r"\?|→|->|!|(?:‖|\|\|)(\d+)")
_LOOKS_LIKE_OPERATOR = re.compile(r"\?|→|->|!|(?:‖|\|\|)\d")
_SIGNS: dict[type, str] = {Fallback: "?", Sequence: "→", Not: "!"}
_EXCERPT = 24


def parse(text: str) -> BehaviorTree:
    """Read a tree.

    Raises:
        NotationError: the text is not exactly one tree; the message names the column, counted from 1.
    """
    reader = _Reader(text)
    tree = reader.node(1)
    reader.end()
    return tree


def format_tree(tree: BehaviorTree) -> str:
    """Write a tree on one line; `parse` reads back the same tree."""
    words: list[str] = []
    _WRITERS[type(tree)](tree, words)
    return " ".join(words)


def format_leaf(leaf: Leaf) -> str:
    """Write a leaf: `[name]`, `(name)`, or with arguments `[name(key=value)]`."""
    return leaf.text


def _write_leaf(leaf: Leaf, words: list[str]) -> None:
    words.append(leaf.text)


def _write_control(node: Control, words: list[str]) -> None:
    words.append(f"{_SIGNS.get(type(node)) or operator(node)}(")
    for child in node.children:
        _WRITERS[type(child)](child, words)
    words.append(")")


def _write_not(node: Not, words: list[str]) -> None:
    child = format_tree(node.child)
    plain = isinstance(node.child, Condition) and not _LOOKS_LIKE_OPERATOR.match(node.child.name)
    words.append(f"!{child}" if plain else f"!({child})")


_WRITERS: Mapping[type[Node], Callable[[Any, list[str]], None]] = {
    Action: _write_leaf,
    Condition: _write_leaf,
    Fallback: _write_control,
    Sequence: _write_control,
    Parallel: _write_control,
    Not: _write_not,
}


def read_leaf(text: str, kind: type[Action | Condition]) -> Leaf:
    """Read what stands between a leaf's brackets: `name` or `name(key=value,key=value)`.

    Raises:
        NotationError: the name or an argument holds what it must not.
    """
    name, opening, arguments = text.strip().partition("(")
    if not opening:
        return kind(name)
    if not arguments.endswith(")"):
        raise NotationError(
            f"cannot read the leaf {shortened(text)}", "write [action], (condition) or [action(key=value)]"
        )
    return kind(name.rstrip(), _arguments(arguments[:-1]))


def operator(node: Node) -> str:
    """The sign of a control node or decorator."""
    if isinstance(node, Parallel):
        return f"‖{node.successes}"
    return _SIGNS[type(node)]


@frozen
class OperatorToken:
    """`?`, `→`, `!` or `‖M`."""

    sign: str


@frozen
class BracketToken:
    """`(` or `)` around children."""

    sign: str


Token: TypeAlias = OperatorToken | BracketToken | Action | Condition


def tokens(text: str) -> tuple[Token, ...]:
    """Cut a piece of notation, which need not be a whole tree, into tokens.

    `(` opens children when it follows an operator or when no name comes before the next bracket; else it is a
    condition's. A grammar's strings are such pieces.

    Raises:
        NotationError: some character belongs to no token.
    """
    reader = _Reader(text)
    found: list[Token] = []
    while not reader.at_end():
        found.append(reader.token(found[-1] if found else None))
    return tuple(found)


class _Reader:
    """A cursor over the text; each method reads one construct or raises with the column."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0

    def node(self, level: int) -> Node:
        if level > MAX_DEPTH:
            raise self.error(f"the tree is deeper than {MAX_DEPTH} levels", "flatten it")
        self.skip_space()
        match = _OPERATOR.match(self.text, self.at)
        if match is None:
            return self.leaf()
        start = self.at
        self.at = match.end()
        if match.group() == "!":
            return Not(self.negated(level + 1))
        parts = self.children(level + 1)
        try:
            return _control(match, parts)
        except NotationError as error:
            self.at = start
            raise self.error(error.message, error.hint) from None

    def negated(self, level: int) -> Node:
        self.skip_space()
        bare = re.compile(r"\(\s*([^\s(\[)\]{}])").match(self.text, self.at)
        if bare and not _LOOKS_LIKE_OPERATOR.match(self.text, bare.start(1)):
            return self.leaf()
        inside = self.children(level)
        if len(inside) != 1:
            raise self.error(f"! takes one child, not {len(inside)}", "put a fallback or sequence around them")
        return inside[0]

    def children(self, level: int) -> tuple[Node, ...]:
        self.expect("(")
        found = []
        while not self.peek(")"):
            found.append(self.node(level))
        self.expect(")")
        if not found:
            raise self.error("a control node without children", "put at least one tree between its parentheses")
        return tuple(found)

    def leaf(self) -> Leaf:
        opening = self.text[self.at : self.at + 1]
        if opening not in ("[", "("):
            raise self.error("expected a tree", "a tree starts with ?, →, !, ‖2, [action] or (condition)")
        end = self.closing(opening)
        kind: type[Action | Condition] = Action if opening == "[" else Condition
        try:
            found = read_leaf(self.text[self.at + 1 : end], kind)
        except NotationError as error:
            raise self.error(error.message, error.hint) from None
        self.at = end + 1
        return found

    def closing(self, opening: str) -> int:
        wanted, level = {"[": "]", "(": ")"}[opening], 0
        for index in range(self.at + 1, len(self.text)):
            char = self.text[index]
            if char == wanted and level == 0:
                return index
            level += (char == "(") - (char == ")")
            if level not in (0, 1) or char in "[]{}":
                break
        raise self.error(f"this {opening!r} is never closed", f"add {wanted!r} after the leaf's name")

    def token(self, previous: Token | None) -> Token:
        self.skip_space()
        match = _OPERATOR.match(self.text, self.at)
        if match:
            self.at = match.end()
            return OperatorToken({"->": "→"}.get(match.group(), match.group().replace("||", "‖")))
        if self.peek(")"):
            self.at += 1
            return BracketToken(")")
        opens = re.compile(r"\(\s*(?:[\[()]|$)").match(self.text, self.at)
        if opens or (self.peek("(") and isinstance(previous, OperatorToken) and previous.sign != "!"):
            self.at += 1
            return BracketToken("(")
        return self.leaf()

    def at_end(self) -> bool:
        self.skip_space()
        return self.at == len(self.text)

    def end(self) -> None:
        if not self.at_end():
            raise self.error("the text goes on after the tree", "put a fallback or sequence around the trees")

    def skip_space(self) -> None:
        while self.text[self.at : self.at + 1].isspace():
            self.at += 1

    def peek(self, sign: str) -> bool:
        self.skip_space()
        return self.text.startswith(sign, self.at)

    def expect(self, sign: str) -> None:
        if not self.peek(sign):
            raise self.error(f"expected {sign!r}", "children stand between parentheses, as in ?( [a] [b] )")
        self.at += 1

    def error(self, message: str, hint: str | None) -> NotationError:
        near = self.text[self.at : self.at + _EXCERPT].strip() or "the end"
        return NotationError(f"{message}, at column {self.at + 1} near {near!r}", hint)


def _control(match: re.Match[str], parts: tuple[Node, ...]) -> Node:
    if match.group(1):
        return Parallel(parts, _small_number(match.group(1)))
    return Fallback(parts) if match.group() == "?" else Sequence(parts)


def _small_number(digits: str) -> int:
    return int(digits[:9])  # more children than this do not exist; int() refuses thousands of digits


def _arguments(text: str) -> Arguments:
    pairs = [part.partition("=") for part in text.split(",")]
    if any(not sign for _, sign, _ in pairs):
        raise NotationError(f"cannot read the arguments {shortened(text)}", "write them as name(key=value,key=value)")
    return tuple((key.strip(), value.strip()) for key, _, value in pairs)
