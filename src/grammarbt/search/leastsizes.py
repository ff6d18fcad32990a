"""The smallest and the lowest trees that begin with each production."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from grammarbt.grammar import BoundGrammar, Production

ENDLESS = 1_000_000


def least_sizes(grammar: BoundGrammar) -> tuple[int, ...]:
    """Per production, the nodes of the smallest tree that begins with it, constraints aside."""

    def size(rule: Production, least: Mapping[int, int]) -> int:
        return sum(
            least.get(symbol, ENDLESS) if grammar.is_nonterminal(symbol) else symbol in grammar.node_terminals
            for symbol in rule.rhs
        )

    return _least(grammar, size)


def least_heights(grammar: BoundGrammar) -> tuple[int, ...]:
    """Per production, the height of the lowest derivation tree that begins with it, constraints aside."""

    def height(rule: Production, least: Mapping[int, int]) -> int:
        return 1 + max((least.get(part, ENDLESS) for part in grammar.parts[rule.number]), default=0)

    return _least(grammar, height)


def _least(grammar: BoundGrammar, measure: Callable[[Production, Mapping[int, int]], int]) -> tuple[int, ...]:
    """A measure of each production, which depends on the least of each nonterminal, until none changes."""
    least: dict[int, int] = {}
    found: tuple[int, ...] = ()
    while True:
        before, found = found, tuple(measure(rule, least) for rule in grammar.productions)
        for rule, value in zip(grammar.productions, found, strict=True):
            least[rule.lhs] = min(value, least.get(rule.lhs, ENDLESS))
        if found == before:
            return found
