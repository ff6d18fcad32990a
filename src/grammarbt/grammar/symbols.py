"""Plain productions: what a grammar is once its templates, variables and repetitions are written out."""

from __future__ import annotations

from typing import TypeAlias

from attrs import field, frozen

from grammarbt.bt.notation import Token
from grammarbt.grammar.diagnostics import Span


@frozen(cache_hash=True)
class Nonterminal:
    """A rule with its arguments filled in, a set of leaves, or a part of a rule in parentheses.

    Attributes:
        name: as shown to people, for example `right{g1}`.
        rule: the rule it comes from; empty for sets of leaves and parts.
        key: tells apart two parts that look alike.
    """

    name: str
    rule: str
    key: object = field(repr=False)


Symbol: TypeAlias = Token | Nonterminal


@frozen
class PlainProduction:
    """`lhs → rhs`, with the groups chosen in it and where it was written."""

    lhs: Nonterminal
    rhs: tuple[Symbol, ...]
    choices: tuple[tuple[str, str], ...]
    weight: float
    alias: str | None
    span: Span = field(eq=False, repr=False)
