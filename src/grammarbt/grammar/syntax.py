"""The syntax tree of a `.grammar` file, as written."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from attrs import field, frozen

from grammarbt.grammar.diagnostics import Span


@frozen
class Reference:
    """A use of a rule, terminal, parameter, variable or group, with template arguments."""

    name: str
    arguments: tuple[Argument, ...]
    span: Span = field(eq=False)


@frozen
class Literal:
    """A string of notation, without its quotes."""

    text: str
    span: Span = field(eq=False)


@frozen
class Choice:
    """`( a | b )`, or with `optional` `[ a | b ]`."""

    alternatives: tuple[Alternative, ...]
    optional: bool
    span: Span = field(eq=False)


@frozen
class Repeat:
    """`x?`, `x*`, `x+`, `x~2..5`; `most` is None when there is no upper bound."""

    item: Expression
    least: int
    most: int | None
    span: Span = field(eq=False)


Argument: TypeAlias = Reference | Literal
Expression: TypeAlias = Reference | Literal | Choice | Repeat


@frozen
class Alternative:
    """A sequence of expressions with its weight and the name of its alias."""

    items: tuple[Expression, ...]
    weight: float
    alias: str | None
    span: Span = field(eq=False)


@frozen
class Rule:
    """`name{parameters}: alternatives`; `span` is the name's."""

    name: str
    parameters: tuple[str, ...]
    alternatives: tuple[Alternative, ...]
    span: Span = field(eq=False)


@frozen
class Declare:
    """`%declare ACTION CONDITION`."""

    names: tuple[str, ...]
    span: Span


@frozen
class ForAll:
    """`%forall g, h in GROUP`."""

    variables: tuple[str, ...]
    domain: str
    span: Span


@frozen
class Unique:
    """`%unique ACTION CONDITION in subtree`: each at most once in whatever the scope's rule derives."""

    names: tuple[str, ...]
    scope: str
    span: Span


@frozen
class Limit:
    """`%limit nodes 40` or `%limit depth 6 in subtree`; without a scope it holds for the whole tree."""

    kind: str
    most: int
    scope: str
    span: Span


@frozen
class Import:
    """`%import name.rule`, `%import .neighbour (a, b)`: `level` dots, the file's name, (rule, name here) pairs."""

    level: int
    module: tuple[str, ...]
    rules: tuple[tuple[str, str], ...]
    span: Span


Item: TypeAlias = Rule | Declare | ForAll | Unique | Limit | Import


def direct_references(alternative: Alternative) -> Iterator[tuple[Reference, bool]]:
    """References of an alternative outside nested parentheses; the flag says whether it is a template argument."""
    for item in alternative.items:
        inner = unrepeated(item)
        if isinstance(inner, Reference):
            yield inner, False
            yield from _argument_references(inner)


def references(alternatives: tuple[Alternative, ...]) -> Iterator[tuple[Reference, bool]]:
    """Every reference, also inside parentheses."""
    for alternative in alternatives:
        yield from direct_references(alternative)
        for item in alternative.items:
            inner = unrepeated(item)
            if isinstance(inner, Choice):
                yield from references(inner.alternatives)


def literals(alternatives: tuple[Alternative, ...]) -> Iterator[Literal]:
    """Every string, also inside parentheses and in template arguments."""
    for alternative in alternatives:
        for item in map(unrepeated, alternative.items):
            if isinstance(item, Choice):
                yield from literals(item.alternatives)
            else:
                yield from _argument_literals(item)


def unrepeated(item: Expression) -> Reference | Literal | Choice:
    """What is repeated, or the expression itself."""
    while isinstance(item, Repeat):
        item = item.item
    return item


def _argument_references(reference: Reference) -> Iterator[tuple[Reference, bool]]:
    for argument in reference.arguments:
        if isinstance(argument, Reference):
            yield argument, True
            yield from _argument_references(argument)


def _argument_literals(item: Argument) -> Iterator[Literal]:
    if isinstance(item, Literal):
        yield item
    else:
        for argument in item.arguments:
            yield from _argument_literals(argument)
