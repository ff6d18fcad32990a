"""Which symbols can stand side by side in a form: a quick way to see that no derivation leads to one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain, product
from typing import TypeAlias

from grammarbt.grammar.reach import reachable
from grammarbt.grammar.table import CLOSE, Production, ProductionTable

EDGE = -1_000_000_000
"""Stands before the first and behind the last symbol of a form."""

_Row: TypeAlias = tuple[int, ...]


def adjacent(grammar: ProductionTable) -> frozenset[tuple[int, int]]:
    """All pairs of neighbours, at least one a nonterminal, in the forms that the start symbol leads to."""
    rows = {lhs: [_marked(grammar, production) for production in own] for lhs, own in grammar.by_lhs.items()}
    empty = _nullable(rows)
    first = {lhs: _first(lhs, rows, empty) for lhs in rows}
    backwards = {lhs: [row[::-1] for row in own] for lhs, own in rows.items()}
    last = {lhs: _first(lhs, backwards, empty) for lhs in rows}
    found: set[tuple[int, int]] = set()
    for one, other in _neighbours([(EDGE, grammar.start_symbol, EDGE), *chain(*rows.values())], empty):
        left, right = last.get(one, (one,)), first.get(other, (other,))
        found.update(product(filter(grammar.is_nonterminal, left), right))
        found.update(product(left, filter(grammar.is_nonterminal, right)))
    return frozenset(found)


def _neighbours(rows: Iterable[_Row], empty: frozenset[int]) -> dict[tuple[int, int], None]:
    """Symbols that come to stand side by side in one of the rows, as what is between them vanishes."""
    found: dict[tuple[int, int], None] = {}
    for row in rows:
        for at, symbol in enumerate(row):
            found.update(dict.fromkeys((symbol, other) for other in _leading(row[at + 1 :], empty)))
    return found


def _marked(grammar: ProductionTable, production: Production) -> _Row:
    """What the production puts into a form, markers included."""
    if not grammar.opens_of(production.lhs):
        return production.rhs
    return (grammar.opening(production.lhs), *production.rhs, CLOSE)


def _nullable(rows: Mapping[int, Sequence[_Row]]) -> frozenset[int]:
    """The nonterminals that can vanish."""
    found: frozenset[int] = frozenset()
    while True:
        more = frozenset(lhs for lhs, own in rows.items() if any(found.issuperset(row) for row in own))
        if more == found:
            return found
        found = more


def _first(symbol: int, rows: Mapping[int, Sequence[_Row]], empty: frozenset[int]) -> _Row:
    """The first symbols of the forms that the nonterminal leads to, itself included."""
    return tuple(reachable(symbol, lambda one: chain.from_iterable(_leading(row, empty) for row in rows.get(one, ()))))


def _leading(row: _Row, empty: frozenset[int]) -> _Row:
    """The symbols that can come first when those before them vanish."""
    end = next((at for at, symbol in enumerate(row) if symbol not in empty), len(row))
    return row[: end + 1]
