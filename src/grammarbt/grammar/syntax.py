"""The syntax tree of a `.grammar` file, as written."""

from __future__ import annotations

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
