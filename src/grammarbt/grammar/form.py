"""Sentential forms: partly derived trees, what may be done next, and what they become.

A form's `used` holds, for each scope marker from left to right, what that scope has used up so far, one number per
constraint the scope belongs to. What is finished to the left of everything else may be dropped: the rest still knows
enough to go on.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TypeAlias

from attrs import Factory, define, frozen

from grammarbt.grammar.needs import ENDLESS, Needs
from grammarbt.grammar.table import CLOSE, Production, ProductionTable
from grammarbt.grammar.vectors import NOTHING, Antichain

Used: TypeAlias = tuple[tuple[int, ...], ...]

MAX_REMEMBERED = 500_000
_NOTHING = -1_000_000_000  # stands for the first symbol of an empty right-hand side


@frozen
class SententialForm:
    """Symbol numbers with scope markers, and what each open scope has used."""

    symbols: tuple[int, ...]
    used: Used = ()

    @property
    def key(self) -> str:
        """A text that two forms share exactly if they are equal; the same in every process."""
        return f"{','.join(map(str, self.symbols))};{self.used}"


class Forms:
    """What can be done with the forms of a grammar."""

    def __init__(self, grammar: ProductionTable) -> None:
        self.grammar = grammar
        self._live: dict[object, Antichain] = {}

    @cached_property
    def needs(self) -> Needs:
        """Minimal needs, computed when first asked for."""
        return Needs(self.grammar)

    def positions(self, form: SententialForm) -> tuple[int, ...]:
        """Where the form's nonterminals stand, left to right."""
        start = self.grammar.start_symbol
        return tuple(at for at, symbol in enumerate(form.symbols) if symbol >= start)

    def legal(self, form: SententialForm, position: int) -> tuple[int, ...]:
        """Productions after which the form can still be finished."""
        own = self.grammar.by_lhs.get(form.symbols[position], ())
        return tuple(
            production.number
            for production in own
            if (after := self.applied(form, production, position)) is not None and self.can_finish(after)
        )

    def applied(self, form: SententialForm, production: Production, position: int) -> SententialForm | None:
        """The form after the production, or None if that breaks a constraint right away."""
        used = list(form.used)
        scopes, opened = _scopes_at(form.symbols, position)
        for scope, marker in scopes:
            after = self._spend(self.grammar.opens_of(self.grammar.opened_by(marker)), used[scope], production)
            if after is None:
                return None
            used[scope] = after
        own, rhs = self.grammar.opens_of(production.lhs), production.rhs
        if own:
            fresh = self._spend(own, (0,) * len(own), production)
            if fresh is None:
                return None
            used.insert(opened, fresh)
            rhs = (self.grammar.opening(production.lhs), *rhs, CLOSE)
        symbols = (*form.symbols[:position], *rhs, *form.symbols[position + 1 :])
        return SententialForm(symbols, tuple(used))

    def _spend(
        self, constraints: tuple[int, ...], used: tuple[int, ...], production: Production
    ) -> tuple[int, ...] | None:
        after = []
        for constraint, so_far in zip(constraints, used, strict=True):
            more, limit = production.use[constraint], self.grammar.costs.constraints[constraint]
            if limit.kind == "unique":
                if so_far & more or constraint in production.clash:
                    return None
                after.append(so_far | more)
            else:
                if limit.kind == "nodes" and so_far + more > limit.most:
                    return None
                after.append(so_far + more)
        return tuple(after)

    def parents(self, form: SententialForm) -> Iterator[tuple[SententialForm, int]]:
        """Every form that becomes this one by one production, by inverse productions, left to right."""
        for position, symbol in enumerate((*form.symbols, None)):
            for production in (*self._by_first.get(symbol, ()), *self._by_first.get(_NOTHING, ())):
                parent = self._undone(form, production, position)
                if parent is not None and self.applied(parent, production, position) == form:
                    yield parent, production.number

    @cached_property
    def _by_first(self) -> dict[int | None, list[Production]]:
        """Productions by the first symbol they put into a form."""
        found: dict[int | None, list[Production]] = {}
        for production in self.grammar.productions:
            opens = self.grammar.opens_of(production.lhs)
            first = self.grammar.opening(production.lhs) if opens else (*production.rhs, _NOTHING)[0]
            found.setdefault(first, []).append(production)
        return found

    def _undone(self, form: SententialForm, production: Production, position: int) -> SententialForm | None:
        rhs = production.rhs
        opens = bool(self.grammar.opens_of(production.lhs))
        if opens:
            rhs = (self.grammar.opening(production.lhs), *rhs, CLOSE)
        end = position + len(rhs)
        if form.symbols[position:end] != rhs:
            return None
        used = list(form.used)
        scopes, opened = _scopes_at(form.symbols, position)
        if opens:
            del used[opened]
        for scope, marker in scopes:
            constraints = self.grammar.opens_of(self.grammar.opened_by(marker))
            used[scope] = tuple(
                so_far - production.use[constraint] for constraint, so_far in zip(constraints, used[scope], strict=True)
            )
        if any(number < 0 for own in used for number in own):
            return None
        return SententialForm((*form.symbols[:position], production.lhs, *form.symbols[end:]), tuple(used))

    def can_finish(self, form: SententialForm) -> bool:
        """Whether some word within all constraints can be derived from the form."""
        return bool(_Regions(self, form).needs())

    def remember(self, key: object, value: Antichain) -> Antichain:
        """Keep a region's needs; forgetting everything now and then bounds the memory."""
        if len(self._live) > MAX_REMEMBERED:
            self._live.clear()
        self._live[key] = value
        return value

    def remembered(self, key: object) -> Antichain | None:
        """A region's needs, if they were computed before."""
        return self._live.get(key)


def _scopes_at(symbols: tuple[int, ...], position: int) -> tuple[list[tuple[int, int]], int]:
    """The scopes open at a position, outermost first, as (place in `used`, marker); and how many opened before it."""
    stack: list[tuple[int, int]] = []
    opened = 0
    for symbol in symbols[:position]:
        if symbol == CLOSE:
            stack.pop()
        elif symbol < 0:
            stack.append((opened, symbol))
            opened += 1
    return stack, opened


class _Regions:
    """One pass over a form: each scope's needs are summed when it closes, and passed on to the scope around it."""

    def __init__(self, forms: Forms, form: SententialForm) -> None:
        self.forms, self.form, self.grammar = forms, form, forms.grammar
        limited = bool(self.grammar.depth_constraints)
        self.depths = _depths(forms, form.symbols) if limited else None

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
        known = self.forms.remembered(key)
        return self.forms.remember(key, self._total(region, used)) if known is None else known

    def _total(self, region: _Region, used: tuple[int, ...]) -> Antichain:
        needs = self.forms.needs
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


def _depths(forms: Forms, symbols: tuple[int, ...]) -> list[int]:
    """The depth that remains at each symbol, by the parentheses still to be closed in each limited scope."""
    opening, closing = forms.grammar.brackets
    limits = _closing_limits(forms, symbols)
    remaining = [ENDLESS] * len(symbols)
    scopes: list[tuple[int, int]] = []
    level = 0
    for at in range(len(symbols) - 1, -1, -1):
        symbol = symbols[at]
        if symbol == CLOSE:
            scopes.append((limits.pop(), level))
        elif symbol < 0:
            scopes.pop()
        else:
            level += (symbol == closing) - (symbol == opening)
            left = (max(most - (level - base), 0) for most, base in scopes if most != ENDLESS)
            remaining[at] = min(left, default=ENDLESS)
    return remaining


def _closing_limits(forms: Forms, symbols: tuple[int, ...]) -> list[int]:
    """Each closing marker's limit on depth, in the order of the closing markers."""
    stack: list[int] = []
    found: list[int] = []
    for symbol in symbols:
        if symbol == CLOSE:
            found.append(forms.needs.inside(forms.grammar.opened_by(stack.pop()), ENDLESS))
        elif symbol < 0:
            stack.append(symbol)
    return found
