"""What the scopes of a derivation use up of what constraints limit, so that open places are filled within it.

The states of leftmost derivations know what *can still be finished*, from what stands to the left. Where most of a
derivation is given, on both sides of a place, it is simpler and much faster to add up what is there, and to see what
that leaves for the place.
"""

from __future__ import annotations

from typing import TypeAlias

from attrs import frozen

from grammarbt.grammar import BoundGrammar
from grammarbt.search.derivations import Template
from grammarbt.search.leastsizes import least_sizes

Charge: TypeAlias = tuple[tuple[int, int], ...]
"""What a production uses, constraint by constraint; those of which it uses nothing are left out."""

Scope: TypeAlias = dict[int, int]
"""Per constraint of a use of a rule, what it has used: leaves as bits, or nodes."""

CLOSE = -1


@frozen(eq=False)
class Place:
    """Where something is to be derived: its nonterminal, and the scopes open there."""

    symbol: int
    scopes: tuple[Scope, ...]


class Tally:
    """Adds up and charges.

    Nodes that a nonterminal needs at least are charged in advance, when it comes up, and settled when it is derived.

    Args:
        grammar: the language; its constraints on depth are not looked at.
    """

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        constraints = grammar.costs.constraints
        self._most = tuple(limit.most if limit.kind == "nodes" else 0 for limit in constraints)
        sizes = least_sizes(grammar)
        own = grammar.by_lhs.items()
        self._least = {lhs: min(sizes[production.number] for production in rules) for lhs, rules in own}
        self._opens = {
            lhs: tuple(at for at in grammar.opens_of(lhs) if constraints[at].kind != "depth") for lhs in grammar.by_lhs
        }
        self._clashes = tuple(bool(production.clash) for production in grammar.productions)
        self.charges = tuple(self._charge(number) for number in range(len(grammar.productions)))

    def _charge(self, number: int) -> Charge:
        production = self.grammar.productions[number]
        growth = sum(self._least[part] for part in self.grammar.parts[number]) - self._least[production.lhs]
        found = (
            (at, use + growth if self._most[at] else use)
            for at, use in enumerate(production.use)
            if self.grammar.costs.constraints[at].kind != "depth"
        )
        return tuple((at, use) for at, use in found if use)

    def opened(self, symbol: int) -> Scope | None:
        """The scope that a use of a nonterminal opens, if it opens one."""
        own = self._opens[symbol]
        return {at: self._least[symbol] if self._most[at] else 0 for at in own} if own else None

    def fits(self, scopes: tuple[Scope, ...], production: int) -> bool:
        """Whether the open scopes can bear a production."""
        for at, use in self.charges[production]:
            most = self._most[at]
            for scope in scopes:
                used = scope.get(at)
                if used is not None and (used + use > most if most else used & use):
                    return False
        return not self._clashes[production] or not any(
            at in scope for at in self.grammar.productions[production].clash for scope in scopes
        )

    def charge(self, scopes: tuple[Scope, ...], production: int) -> None:
        """Charge a production to the scopes open where it is used."""
        for at, use in self.charges[production]:
            most = self._most[at]
            for scope in scopes:
                if at in scope:
                    scope[at] = scope[at] + use if most else scope[at] | use

    def places(self, template: Template) -> list[Place] | None:
        """The open places of a derivation, all that is given charged; None if it is none, or breaks a constraint."""
        found: list[Place] = []
        pending = [self.grammar.start_symbol]
        scopes: tuple[Scope, ...] = ()
        for production in template:
            while pending and pending[-1] == CLOSE:
                pending.pop()
                scopes = scopes[:-1]
            if not pending:
                return None
            symbol = pending.pop()
            if production is None:
                found.append(Place(symbol, scopes))
                continue
            scope = self.opened(symbol)
            if scope is not None:
                scopes = (*scopes, scope)
                pending.append(CLOSE)
            if self.grammar.productions[production].lhs != symbol or not self.fits(scopes, production):
                return None
            self.charge(scopes, production)
            pending += self.grammar.parts[production][::-1]
        return None if any(symbol != CLOSE for symbol in pending) else found
