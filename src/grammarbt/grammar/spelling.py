"""Sentential forms as short texts, for searches that keep millions of them.

A symbol is a character. The marker that opens a scope and what the scope has used so far are one character together,
given out when it is first met. So equal forms are equal texts, and a production replaces a character by a text.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from functools import cached_property, lru_cache
from typing import TypeAlias

from grammarbt.errors import GrammarError
from grammarbt.grammar.adjacency import EDGE, adjacent
from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.independence import is_independent
from grammarbt.grammar.table import CLOSE, Production

CLOSED = chr(0)
"""The character of the marker that closes a scope."""

REMEMBERED = 256
"""Forms whose parents are kept; a search for ancestors looks at some of them more than once."""

MAX_SCOPES = 200_000
"""Independent scopes of which the parents are kept."""

Above: TypeAlias = tuple[str, int, int]
"""A form, a production, and the place in the form where it is applied."""

_Charge: TypeAlias = Callable[[str, int], "str | None"]


class Spelling:
    """Spells the forms of a grammar, and rewrites them as they are spelled.

    Attributes:
        grammar: the language.
        first_scope: the lowest character that opens a scope; all from there on do.
        independent: the characters of independent nonterminals.
        parents: the forms that become a form by one production, left to right, but for some that no derivation from the
            start symbol leads to.
    """

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self.first_scope = self._character(len(grammar.terminals) + len(grammar.names))
        self.independent = frozenset(
            self._character(symbol) for symbol in grammar.by_lhs if is_independent(grammar, symbol)
        )
        self._sealed: set[str] = set()
        self._all_sealed = True
        scopes = f"{re.escape(self.first_scope)}-{chr(sys.maxunicode)}"
        self._innermost = re.compile(f"[{scopes}][^{CLOSED}{scopes}]*{CLOSED}|.", re.DOTALL)
        self._inside: dict[str, tuple[Above, ...]] = {}
        self._scopes: list[tuple[int, tuple[int, ...]]] = []
        self._known: dict[tuple[int, tuple[int, ...]], str] = {}
        self._unused: dict[str, str] = {}
        self._spent: dict[tuple[str, int], str | None] = {}
        self._regained: dict[tuple[str, int], str | None] = {}
        self._rows = tuple(map(self._row, grammar.productions))
        self._charging = tuple(any(production.use) or bool(production.clash) for production in grammar.productions)
        first, last = self._character(grammar.start_symbol), chr(ord(self.first_scope) - 1)
        self._nonterminals = re.compile(f"[{re.escape(first)}-{re.escape(last)}]")
        self.parents = lru_cache(REMEMBERED)(self._parents)

    # Texts and forms

    def text(self, form: SententialForm) -> str:
        """The form, spelled."""
        used = iter(form.used)
        return "".join(
            self._scope(symbol, next(used)) if symbol < CLOSE else self._character(symbol) for symbol in form.symbols
        )

    def form(self, text: str) -> SententialForm:
        """The form that a text spells."""
        symbols, used = [], []
        for character in text:
            symbol = self.symbol(character)
            symbols.append(symbol)
            if symbol < CLOSE:
                used.append(self._scope_of(character)[1])
        return SententialForm(tuple(symbols), tuple(used))

    def symbol(self, character: str) -> int:
        """A character's symbol or marker."""
        return self._scope_of(character)[0] if character >= self.first_scope else ord(character) - 1

    def nonterminals(self, text: str) -> str:
        """The nonterminals of a form, left to right."""
        return "".join(self._nonterminals.findall(text))

    def positions(self, text: str) -> list[int]:
        """Where the nonterminals stand, left to right."""
        return [match.start() for match in self._nonterminals.finditer(text)]

    def place(self, text: str, at: int) -> int:
        """How many nonterminals stand before a position."""
        return len(self._nonterminals.findall(text, 0, at))

    def tokens(self, text: str) -> list[str]:
        """The characters of a form; those of an independent scope that has no other inside are one token."""
        found: list[str] = self._innermost.findall(text)
        if self._all_sealed:
            return found
        return [own for token in found for own in ((token,) if token[0] in self._sealed else token)]

    def _character(self, symbol: int) -> str:
        return chr(symbol + 1)

    def _scope_of(self, character: str) -> tuple[int, tuple[int, ...]]:
        return self._scopes[ord(character) - ord(self.first_scope)]

    def _scope(self, marker: int, used: tuple[int, ...]) -> str:
        scope = marker, used
        known = self._known.get(scope)
        if known is None:
            number = ord(self.first_scope) + len(self._scopes)
            if number > sys.maxunicode:
                raise GrammarError(
                    "the scopes of the forms that are kept differ in too many ways", "restart more often"
                )
            known = self._known[scope] = chr(number)
            self._scopes.append(scope)
            if self._character(self.grammar.opened_by(marker)) in self.independent:
                self._sealed.add(known)
            else:
                self._all_sealed = False
            self._unused[known] = self._scope(marker, (0,) * len(used)) if any(used) else known
        return known

    # Rewriting

    def applied(self, text: str, production: int, at: int) -> str | None:
        """The form after the production at a position, or None if that breaks a constraint right away."""
        row = self._rows[production]
        head = self._charged(text[:at], production, self._spend)
        return None if row is None or head is None else head + row + text[at + 1 :]

    def apply(self, text: str, production: int, at: int) -> str:
        """The form after the production at a position.

        Raises:
            GrammarError: the production breaks a constraint.
        """
        after = self.applied(text, production, at)
        if after is None:
            raise GrammarError(f"{self.grammar.production_text(production)} breaks a constraint", "ask legal() first")
        return after

    def _row(self, production: Production) -> str | None:
        """What the production puts into a text; None if it breaks a constraint by itself."""
        own = self.grammar.opens_of(production.lhs)
        row = "".join(map(self._character, production.rhs))
        if not own:
            return row
        fresh = self.grammar.forms.spend(own, (0,) * len(own), production)
        return None if fresh is None else self._scope(self.grammar.opening(production.lhs), fresh) + row + CLOSED

    def _charged(self, head: str, production: int, charge: _Charge) -> str | None:
        """The text before a place, with what the production uses charged to every scope open there."""
        if not self._charging[production]:
            return head
        closed = 0
        for at in range(len(head) - 1, -1, -1):
            if head[at] == CLOSED:
                closed += 1
            elif head[at] >= self.first_scope:
                if closed:
                    closed -= 1
                    continue
                after = charge(head[at], production)
                if after is None:
                    return None
                sealed = head[at] in self._sealed
                head = head[:at] + after + head[at + 1 :]
                if sealed:  # what is around does not count what is inside
                    break
        return head

    def _spend(self, scope: str, production: int) -> str | None:
        key = scope, production
        if key not in self._spent:
            marker, used = self._scope_of(scope)
            constraints = self.grammar.opens_of(self.grammar.opened_by(marker))
            after = self.grammar.forms.spend(constraints, used, self.grammar.productions[production])
            self._spent[key] = None if after is None else self._scope(marker, after)
        return self._spent[key]

    def _regain(self, scope: str, production: int) -> str | None:
        """The scope before the production, if there can have been one."""
        key = scope, production
        if key not in self._regained:
            marker, used = self._scope_of(scope)
            use = self.grammar.productions[production].use
            constraints = self.grammar.opens_of(self.grammar.opened_by(marker))
            before = tuple(so_far - use[constraint] for constraint, so_far in zip(constraints, used, strict=True))
            earlier = None if any(number < 0 for number in before) else self._scope(marker, before)
            self._regained[key] = earlier if earlier and self._spend(earlier, production) == scope else None
        return self._regained[key]

    def _parents(self, text: str) -> tuple[Above, ...]:
        found: list[Above] = []
        at, starts, vanishing = 0, self._by_first, bool(self._empty)
        for token in self.tokens(text):
            if token[0] in starts or vanishing:
                found += self._parents_at(text, at)
            if len(token) > 1:
                before, after = text[:at], text[at + len(token) :]
                found += [(before + above + after, number, at + own) for above, number, own in self._within(token)]
            at += len(token)
        if vanishing:
            found += self._parents_at(text, at)
        return tuple(found)

    def _parents_at(self, text: str, at: int) -> list[Above]:
        """Those by a production at one place."""
        found: list[Above] = []
        for row, lhs, production in self._by_first.get(text[at : at + 1], self._empty):
            end = at + len(row)
            if text.startswith(row, at) and self._may_stand(text[at - 1 : at], lhs, text[end : end + 1]):
                head = self._charged(text[:at], production, self._regain)
                if head is not None:
                    found.append((head + lhs + text[end:], production, at))
        return found

    def _within(self, scope: str) -> tuple[Above, ...]:
        """What an independent scope may have been before a production inside it, the same wherever it stands."""
        known = self._inside.get(scope)
        if known is None:
            if len(self._inside) >= MAX_SCOPES:
                self._inside.clear()
            known = self._inside[scope] = tuple(
                above for at in range(1, len(scope)) for above in self._parents_at(scope, at)
            )
        return known

    def _may_stand(self, before: str, symbol: str, after: str) -> bool:
        before, after = self._unused.get(before, before), self._unused.get(after, after)
        return (before, symbol) in self._adjacent and (symbol, after) in self._adjacent

    @cached_property
    def _adjacent(self) -> frozenset[tuple[str, str]]:
        """Neighbours as characters, scopes as if unused, no character where a form ends."""
        pairs = adjacent(self.grammar)
        name = {symbol: self._representative(symbol) for pair in pairs for symbol in pair}
        return frozenset((name[one], name[other]) for one, other in pairs)

    def _representative(self, symbol: int) -> str:
        if symbol == EDGE:
            return ""
        if symbol >= CLOSE:
            return self._character(symbol)
        return self._scope(symbol, (0,) * len(self.grammar.opens_of(self.grammar.opened_by(symbol))))

    @cached_property
    def _empty(self) -> tuple[tuple[str, str, int], ...]:
        return self._by_first.get("", ())

    @cached_property
    def _by_first(self) -> dict[str, tuple[tuple[str, str, int], ...]]:
        """What productions put into a text, their left-hand side and number, by the first character."""
        rules = [
            (row, self._character(production.lhs), production.number)
            for production, row in zip(self.grammar.productions, self._rows, strict=True)
            if row is not None
        ]
        empty = tuple(rule for rule in rules if not rule[0])
        found: dict[str, tuple[tuple[str, str, int], ...]] = {"": empty}
        for rule in rules:
            if rule[0]:
                found[rule[0][0]] = (*found.get(rule[0][0], ()), rule)
        return {first: own if own is empty else (*own, *empty) for first, own in found.items()}
