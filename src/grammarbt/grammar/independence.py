"""Which nonterminals are derived each by itself, as nothing below them has a say in what is legal around them."""

from __future__ import annotations

from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.reach import reachable


def is_independent(grammar: BoundGrammar, nonterminal: int) -> bool:
    """Whether what the nonterminal derives has no say in what may stand around it."""
    around = grammar.encloses_of(nonterminal)

    def parts(symbol: int) -> list[int]:
        return [part for production in grammar.by_lhs.get(symbol, ()) for part in grammar.parts[production.number]]

    below = (production for symbol in reachable(nonterminal, parts) for production in grammar.by_lhs.get(symbol, ()))
    if any(production.use[constraint] for production in below for constraint in around):
        return False
    return not around & grammar.depth_constraints
