"""Looking ahead in a tree that is being read: how many trees come before the next parenthesis closes."""

from __future__ import annotations

from functools import lru_cache

from attrs import frozen

from grammarbt.bt.notation import BracketToken, OperatorToken, Token
from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.form import SententialForm

PATIENCE = 4
"""Rounds after which a number of trees that still grows counts as without bound."""

MANY = 1_000_000
"""Stands for any number of trees."""

OPEN, CLOSED = BracketToken("("), BracketToken(")")


@frozen
class _Arity:
    """How many whole trees a symbol stands for, at least and at most."""

    least: int
    most: int


class Lookahead:
    """Compares how many trees come before the parenthesis closes: in a state, and in the tree."""

    def __init__(self, bound: BoundGrammar, row: tuple[Token, ...]) -> None:
        self.opening, self.closing = bound.brackets
        self.arities = _arities(bound)
        self.left = _trees_left(row)

    def fits(self, at: int, state: SententialForm) -> bool:
        """Whether what a state will spell can have as many trees as the row has from `at` on."""
        least = most = level = 0
        for symbol in state.symbols:
            if symbol == self.closing:
                level -= 1
                if level < 0:
                    break
            elif symbol == self.opening:
                least, most = (least + 1, most + 1) if level == 0 else (least, most)
                level += 1
            elif level == 0 and symbol >= 0:
                least += self.arities[symbol].least
                most += self.arities[symbol].most
        return least <= self.left[at] <= most


def _trees_left(row: tuple[Token, ...]) -> tuple[int, ...]:
    """For each place, the trees between it and the next parenthesis that closes something open there."""
    found = [0] * (len(row) + 1)
    partner: list[int] = []
    for at in range(len(row) - 1, -1, -1):
        token = row[at]
        if token == CLOSED:
            partner.append(at)
        elif token == OPEN:
            found[at] = 1 + found[partner.pop() + 1]
        else:
            found[at] = found[at + 1] + (not isinstance(token, OperatorToken))
    return tuple(found)


@lru_cache(maxsize=8)
def _arities(bound: BoundGrammar) -> tuple[_Arity, ...]:
    """Every symbol's arity, by fixpoint; an operator counts nothing, its parentheses count as the tree."""
    leaves = (not isinstance(token, OperatorToken | BracketToken) for token in bound.terminals)
    found = [_Arity(leaf, leaf) for leaf in leaves] + [_Arity(MANY, 0)] * len(bound.names)
    rounds, before = 0, tuple[_Arity, ...]()
    while before != tuple(found):
        rounds, before = rounds + 1, tuple(found)
        for production in reversed(bound.productions):
            old = found[production.lhs]
            least, most = _row_arity(bound, production.rhs, found)
            if most > old.most and rounds > PATIENCE:
                most = MANY
            found[production.lhs] = _Arity(min(old.least, least), max(old.most, most))
    return before


def _row_arity(bound: BoundGrammar, rhs: tuple[int, ...], arities: list[_Arity]) -> tuple[int, int]:
    opening, closing = bound.brackets
    least = most = level = 0
    for symbol in rhs:
        level -= symbol == closing
        if level == 0 and symbol == opening:
            least, most = least + 1, most + 1
        elif level == 0 and symbol != closing:
            least, most = least + arities[symbol].least, most + arities[symbol].most
        level += symbol == opening
    return min(least, MANY), min(most, MANY)
