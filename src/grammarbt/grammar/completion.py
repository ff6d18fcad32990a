"""Can a sentential form still become a word within all constraints?

Each scope of the form is asked what it needs of the scopes around it: what its nonterminals need at least, summed, if
that fits into what the scope has left.
"""

from __future__ import annotations

from functools import cached_property
from typing import TypeAlias

from attrs import Factory, define

from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.needs import ENDLESS, EntangledError, Needs
from grammarbt.grammar.table import CLOSE, ProductionTable
from grammarbt.grammar.vectors import NOTHING, Antichain

MAX_KEPT = 1_000_000
"""Nonterminals in the scopes that are kept, all together."""

RegionKey: TypeAlias = tuple[int, tuple[int, ...], tuple[tuple[int, int], ...], tuple[Antichain, ...]]
"""A scope's marker, what it has used, its nonterminals with the depth that remains, what scopes inside it need."""


class Completion:
    """Answers for the forms of a grammar; what a scope's content needs is computed once."""

    def __init__(self, grammar: ProductionTable) -> None:
        self.grammar = grammar
        self._live: dict[RegionKey, Antichain] = {}
        self._kept = 0

    @cached_property
    def needs(self) -> Needs:
        """Minimal needs, computed when first asked for."""
        return Needs(self.grammar)

    def is_possible(self, form: SententialForm) -> bool:
        """Whether some word can be derived from the form.

        Raises:
            EntangledError: that takes too long to tell; it shows the form.
        """
        try:
            return bool(_Regions(self, form).needs())
        except EntangledError:
            symbols = (self.grammar.symbol_text(symbol) for symbol in form.symbols if symbol >= 0)
            raise EntangledError(self.grammar, " ".join(symbols)) from None

    def remember(self, key: RegionKey, value: Antichain) -> Antichain:
        """Keep a scope's needs; forgetting everything now and then bounds the memory."""
        self._kept += 1 + len(key[2])
        if self._kept > MAX_KEPT:
            self._kept = 0
            self._live.clear()
        self._live[key] = value
        return value

    def remembered(self, key: RegionKey) -> Antichain | None:
        """A scope's needs, if they were computed before."""
        return self._live.get(key)


class _Regions:
    """One pass over a form: each scope's needs are summed when it closes, and passed on to the scope around it."""

    def __init__(self, completion: Completion, form: SententialForm) -> None:
        self.completion, self.form, self.grammar = completion, form, completion.grammar
        limited = bool(self.grammar.depth_constraints)
        self.depths = _depths(completion.needs, form.symbols) if limited else None

    def needs(self) -> Antichain:
        """What the form needs from outside: nothing, or, if it cannot be finished, no vector at all."""
        if self.depths and self._too_deep(self.depths):
            return ()
        stack = [_Region(0, -1)]
        opened = 0
        for at, symbol in enumerate(self.form.symbols):
            if symbol >= self.grammar.start_symbol:
                stack[-1].pending.append((symbol, self.depths[at] if self.depths else ENDLESS))
            elif symbol == CLOSE:
                needs = self._sum(stack.pop())
                if not needs:
                    return ()
                if needs != NOTHING:
                    stack[-1].inner.append(needs)
            elif symbol < 0:
                stack.append(_Region(symbol, opened))
                opened += 1
        return self._sum(stack[0])

    def _too_deep(self, depths: list[int]) -> bool:
        nodes = self.grammar.node_terminals
        return any(symbol in nodes and depth < 1 for symbol, depth in zip(self.form.symbols, depths, strict=True))

    def _sum(self, region: _Region) -> Antichain:
        if not region.pending and not region.inner:
            return NOTHING
        used = self.form.used[region.scope] if region.marker else ()
        key = (region.marker, used, tuple(region.pending), tuple(region.inner))
        known = self.completion.remembered(key)
        return self.completion.remember(key, self._total(region, used)) if known is None else known

    def _total(self, region: _Region, used: tuple[int, ...]) -> Antichain:
        needs = self.completion.needs
        parts = [*(needs.of(symbol, depth) for symbol, depth in region.pending), *region.inner]
        if not all(parts):
            return ()
        marker = region.marker
        around = self.grammar.encloses_of(self.grammar.opened_by(marker)) if marker else ()
        return needs.total([part for part in parts if part != NOTHING], (), self._left(marker, used), around)

    def _left(self, marker: int, used: tuple[int, ...]) -> dict[int, int]:
        if not marker:
            return {}
        amounts = dict(zip(self.grammar.opens_of(self.grammar.opened_by(marker)), used, strict=True))
        left = {}
        for at, dimension in enumerate(self.grammar.costs.dimensions):
            if dimension.constraint in amounts:
                gone = amounts[dimension.constraint]
                left[at] = dimension.capacity - ((gone & dimension.mask).bit_count() if dimension.mask else gone)
        return left


@define
class _Region:
    """A scope in the making: its marker (0 outside all scopes) and its place in `used`."""

    marker: int
    scope: int
    pending: list[tuple[int, int]] = Factory(list)
    inner: list[Antichain] = Factory(list)


def _depths(needs: Needs, symbols: tuple[int, ...]) -> list[int]:
    """The depth that remains at each symbol, by the parentheses still to be closed in each limited scope."""
    opening, closing = needs.grammar.brackets
    limits = _closing_limits(needs, symbols)
    remaining = [ENDLESS] * len(symbols)
    bounds = [ENDLESS]  # the level that must not be passed in the scopes open here, innermost last
    level = 0
    for at in range(len(symbols) - 1, -1, -1):
        symbol = symbols[at]
        if symbol == CLOSE:
            bounds.append(min(bounds[-1], limits.pop() + level))
        elif symbol < 0:
            bounds.pop()
        else:
            level += (symbol == closing) - (symbol == opening)
            if bounds[-1] < ENDLESS:
                remaining[at] = max(bounds[-1] - level, 0)
    return remaining


def _closing_limits(needs: Needs, symbols: tuple[int, ...]) -> list[int]:
    """Each closing marker's limit on depth, in the order of the closing markers."""
    stack: list[int] = []
    found: list[int] = []
    for symbol in symbols:
        if symbol == CLOSE:
            found.append(needs.inside(needs.grammar.opened_by(stack.pop()), ENDLESS))
        elif symbol < 0:
            stack.append(symbol)
    return found
