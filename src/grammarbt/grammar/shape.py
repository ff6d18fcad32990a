"""Does every word of a grammar read as one behavior tree? Answered from the productions, without deriving anything.

A nonterminal stands either for an operator (all its alternatives are single signs) or for a row of whole trees; of the
latter we compute how many trees at least and at most.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeAlias

import networkx as nx

from grammarbt.bt.notation import BracketToken, OperatorToken
from grammarbt.grammar.diagnostics import Diagnostic
from grammarbt.grammar.grouping import grouped
from grammarbt.grammar.model import START
from grammarbt.grammar.symbols import Nonterminal, PlainProduction, Symbol

_CHILDREN = 'write for example "?" "(" x ")"'

MANY = 1_000_000
"""Stands for any number of trees."""

Arity: TypeAlias = tuple[int, int]


def operators(productions: Sequence[PlainProduction]) -> dict[Nonterminal, frozenset[str]]:
    """The nonterminals that stand for an operator, each with the signs it may become."""
    alternatives = grouped(productions, lambda production: production.lhs)
    signs: dict[Nonterminal, frozenset[str]] = {}
    changed = True
    while changed:
        changed = False
        for lhs, own in alternatives.items():
            parts = [_sign_set(production, signs) for production in own]
            if lhs not in signs and lhs.rule != START and all(parts):
                signs[lhs] = frozenset().union(*parts)
                changed = True
    return signs


def _sign_set(production: PlainProduction, signs: dict[Nonterminal, frozenset[str]]) -> frozenset[str]:
    if len(production.rhs) != 1:
        return frozenset()
    symbol = production.rhs[0]
    if isinstance(symbol, OperatorToken):
        return frozenset({symbol.sign})
    return signs.get(symbol, frozenset()) if isinstance(symbol, Nonterminal) else frozenset()


def levels(production: PlainProduction) -> tuple[int, ...]:
    """How deep inside the production's own parentheses each symbol stands; parentheses count as outside."""
    found, level = [], 0
    for symbol in production.rhs:
        if isinstance(symbol, BracketToken):
            level -= symbol.sign == ")"
            found.append(level)
            level += symbol.sign == "("
        else:
            found.append(level)
    return tuple(found)


def shape_findings(productions: Sequence[PlainProduction]) -> tuple[Diagnostic, ...]:
    """Everything that keeps a word from being a tree; empty when all words are trees."""
    signs = operators(productions)
    rows = [production for production in productions if production.lhs not in signs]
    findings = [finding for production in rows for finding in _bracket_findings(production, signs)]
    if not findings:
        arities = _arities(rows, signs)
        findings = [finding for production in rows for finding in _arity_findings(production, signs, arities)]
    return tuple(dict.fromkeys(findings))


def _bracket_findings(production: PlainProduction, signs: dict[Nonterminal, frozenset[str]]) -> Iterator[Diagnostic]:
    level, awaiting = 0, False
    for symbol in production.rhs:
        sign = symbol.sign if isinstance(symbol, BracketToken) else ""
        if awaiting != (sign == "("):
            message = "an operator is not followed by '('" if awaiting else "'(' without an operator before it"
            yield Diagnostic("G303", message, production.span, _CHILDREN)
            return
        awaiting = isinstance(symbol, OperatorToken) or symbol in signs
        level += (sign == "(") - (sign == ")")
        if level < 0:
            break
    if awaiting:
        yield Diagnostic("G303", "an operator is not followed by '('", production.span, _CHILDREN)
    elif level:
        message = "the parentheses of this alternative do not match"
        help_ = "every alternative must open and close its own, so that each word is a tree"
        yield Diagnostic("G301", message, production.span, help_)


def _arities(rows: Sequence[PlainProduction], signs: dict[Nonterminal, frozenset[str]]) -> dict[Nonterminal, Arity]:
    """Least and most trees in a row, rules that others are made of first; nonterminals that never end are missing."""
    own = grouped(rows, lambda production: production.lhs)
    graph: nx.DiGraph[Nonterminal] = nx.DiGraph()
    graph.add_nodes_from(own)
    for production in rows:
        for symbol in _outside(production):
            if isinstance(symbol, Nonterminal) and symbol not in signs:
                graph.add_edge(production.lhs, symbol)
    arities: dict[Nonterminal, Arity] = {}
    for component in nx.strongly_connected_components(graph):  # in reverse topological order
        _settle([production for lhs in component for production in own.get(lhs, ())], signs, arities)
    return arities


def _settle(
    productions: Sequence[PlainProduction],
    signs: dict[Nonterminal, frozenset[str]],
    arities: dict[Nonterminal, Arity],
) -> None:
    """Fixpoint over rules that are made of each other; what still grows after a round is without bound."""
    changed, first = True, True
    while changed:
        changed = False
        for production in productions:
            row = _row(production.rhs, signs, arities)
            if row is None:
                continue
            old = arities.get(production.lhs, row)
            most = max(old[1], row[1])
            new = (min(old[0], row[0]), most if first or most == old[1] else MANY)
            changed |= arities.get(production.lhs) != new
            arities[production.lhs] = new
        first = first and any(production.lhs not in arities for production in productions)


def _outside(production: PlainProduction) -> list[Symbol]:
    """The symbols that stand in no parentheses of the production's own."""
    pairs = zip(production.rhs, levels(production), strict=True)
    return [symbol for symbol, level in pairs if not level and not isinstance(symbol, BracketToken)]


def _row(
    symbols: Sequence[Symbol], signs: dict[Nonterminal, frozenset[str]], arities: dict[Nonterminal, Arity]
) -> Arity | None:
    least, most, level = 0, 0, 0
    for symbol in symbols:
        if isinstance(symbol, BracketToken):
            level += 1 if symbol.sign == "(" else -1
            continue
        if level:
            continue
        own: Arity | None = (1, 1)
        if isinstance(symbol, Nonterminal) and symbol not in signs:
            own = arities.get(symbol)
        if own is None:
            return None
        least, most = least + own[0], min(most + own[1], MANY)
    return least, most


def _arity_findings(
    production: PlainProduction, signs: dict[Nonterminal, frozenset[str]], arities: dict[Nonterminal, Arity]
) -> Iterator[Diagnostic]:
    for symbol, inside in _operands(production, signs):
        row = _row(inside, signs, arities)
        if row is None:
            continue
        for sign in sorted({symbol.sign} if isinstance(symbol, OperatorToken) else signs[symbol]):
            yield from _operand_findings(production, sign, row)
    if production.lhs.rule == START and (own := _row(production.rhs, signs, arities)) and own != (1, 1):
        message = f"`start` stands for {_many(own)} trees, not one"
        yield Diagnostic("G305", message, production.span, 'put them under a control node, as in "?" "(" … ")"')


def _operand_findings(production: PlainProduction, sign: str, row: Arity) -> Iterator[Diagnostic]:
    if sign == "!" and row != (1, 1):
        message = f"`!` takes one child, but here it can get {_many(row)}"
        yield Diagnostic("G302", message, production.span, "put a control node around them")
    elif row[0] == 0:
        message = f"`{sign}` can be left without children here"
        yield Diagnostic("G304", message, production.span, "use + where * stands, or add a child")
    elif sign.startswith("‖") and not 1 <= int(sign[1:10]) <= row[0]:
        message = f"`{sign}` can have only {row[0]} children here"
        yield Diagnostic("G306", message, production.span, "lower the number, or give it more children")


def _operands(
    production: PlainProduction, signs: dict[Nonterminal, frozenset[str]]
) -> Iterator[tuple[OperatorToken | Nonterminal, Sequence[Symbol]]]:
    """Each operator with the symbols between its parentheses."""
    opened: list[tuple[Symbol, int]] = []
    for at, symbol in enumerate(production.rhs):
        if not isinstance(symbol, BracketToken):
            continue
        if symbol.sign == "(":
            opened.append((production.rhs[at - 1], at + 1))
            continue
        owner, start = opened.pop()
        if isinstance(owner, OperatorToken) or (isinstance(owner, Nonterminal) and owner in signs):
            yield owner, production.rhs[start:at]


def _many(row: Arity) -> str:
    if row[0] == row[1]:
        return str(row[0])
    return f"{row[0]} or more" if row[1] >= MANY else f"{row[0]} to {row[1]}"
