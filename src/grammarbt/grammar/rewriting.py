"""What sentential forms become by productions, and what they came from."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from grammarbt.grammar.completion import Completion
from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.needs import Needs
from grammarbt.grammar.table import CLOSE, Production, ProductionTable

_NOTHING = -1_000_000_000  # stands for the first symbol of an empty right-hand side


class Forms:
    """What can be done with the forms of a grammar."""

    def __init__(self, grammar: ProductionTable) -> None:
        self.grammar = grammar
        self.completion = Completion(grammar)

    @property
    def needs(self) -> Needs:
        """Minimal needs, computed when first asked for."""
        return self.completion.needs

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
            after = self.spend(self.grammar.opens_of(self.grammar.opened_by(marker)), used[scope], production)
            if after is None:
                return None
            used[scope] = after
        own, rhs = self.grammar.opens_of(production.lhs), production.rhs
        if own:
            fresh = self.spend(own, (0,) * len(own), production)
            if fresh is None:
                return None
            used.insert(opened, fresh)
            rhs = (self.grammar.opening(production.lhs), *rhs, CLOSE)
        symbols = (*form.symbols[:position], *rhs, *form.symbols[position + 1 :])
        return SententialForm(symbols, tuple(used))

    def spend(
        self, constraints: tuple[int, ...], used: tuple[int, ...], production: Production
    ) -> tuple[int, ...] | None:
        """What a scope has used after the production, per constraint; None if that breaks one."""
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
        """Whether some word within all constraints can be derived from the form.

        Raises:
            EntangledError: that takes too long to tell.
        """
        return self.completion.is_possible(form)


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
