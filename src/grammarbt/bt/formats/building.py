"""What all readers share: building nodes, with errors that name the place."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from grammarbt.bt.model import MAX_DEPTH, Action, Condition, Fallback, Leaf, Node, Not, Parallel, Sequence
from grammarbt.bt.notation import read_leaf
from grammarbt.errors import FormatError, NotationError

if TYPE_CHECKING:
    from collections.abc import Sequence as AbstractSequence

_PARALLEL = re.compile(r"‖(\d{1,9})")


def control_node(sign: str, parts: AbstractSequence[Node], place: str) -> Node:
    """The control node or decorator with that sign: `?`, `→`, `!` or `‖M`.

    Raises:
        FormatError: it cannot have these children.
    """
    parallel = _PARALLEL.fullmatch(sign)
    try:
        if parallel:
            return Parallel(tuple(parts), int(parallel.group(1)))
        if sign == "!":
            return _negation(parts)
        return Fallback(tuple(parts)) if sign == "?" else Sequence(tuple(parts))
    except NotationError as error:
        raise FormatError(f"{error.message}, {place}", error.hint) from None


def leaf_node(kind: type[Action | Condition], text: str, place: str) -> Leaf:
    """The leaf written `name` or `name(key=value)`.

    Raises:
        FormatError: a name cannot be that.
    """
    try:
        return read_leaf(text, kind)
    except NotationError as error:
        raise FormatError(f"{error.message}, {place}", error.hint) from None


def check_level(level: int, place: str) -> None:
    """Refuse trees deeper than the model allows.

    Raises:
        FormatError: `level`, counted from 1, is too deep.
    """
    if level > MAX_DEPTH:
        raise FormatError(f"the tree is deeper than {MAX_DEPTH} levels, {place}", "flatten it")


def _negation(parts: AbstractSequence[Node]) -> Not:
    if len(parts) != 1:
        raise NotationError(f"! takes one child, not {len(parts)}", "put a fallback or sequence around them")
    return Not(parts[0])
