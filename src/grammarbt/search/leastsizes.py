"""The nodes of the smallest trees."""

from __future__ import annotations

from grammarbt.grammar import BoundGrammar

ENDLESS = 1_000_000


def least_sizes(grammar: BoundGrammar) -> tuple[int, ...]:
    """Per production, the nodes of the smallest tree that begins with it, constraints aside."""
    least: dict[int, int] = {}
    sizes: tuple[int, ...] = ()
    while True:
        before = sizes
        sizes = tuple(
            sum(least.get(symbol, ENDLESS) if grammar.is_nonterminal(symbol) else symbol in grammar.node_terminals
                for symbol in rule.rhs)
            for rule in grammar.productions
        )  # fmt: skip
        for rule, size in zip(grammar.productions, sizes, strict=True):
            least[rule.lhs] = min(size, least.get(rule.lhs, ENDLESS))
        if sizes == before:
            return sizes
