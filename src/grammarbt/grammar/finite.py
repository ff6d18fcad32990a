"""Can derivations go on for ever?

They can if some circle of productions uses up nothing that a scope around it has a limited amount of.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import networkx as nx

from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.grouping import grouped
from grammarbt.grammar.table import Production


def is_finite(bound: BoundGrammar, usable: Iterable[Production]) -> bool:
    """Whether the language has finitely many derivations, all of which take usable productions only."""
    productions = tuple(usable)
    return not endless(bound, productions, _always_open(bound, productions))


def endless(
    bound: BoundGrammar, productions: Iterable[Production], limiting: Mapping[int, frozenset[int]]
) -> frozenset[int]:
    """Nonterminals that can come back to themselves at no cost.

    Args:
        bound: the language.
        productions: those that may be taken.
        limiting: for each nonterminal, the constraints to be minded in it.
    """
    needs = bound.forms.needs
    graph: nx.DiGraph[int] = nx.DiGraph()
    for production in productions:
        for at, symbol in enumerate(production.rhs):
            if bound.is_nonterminal(symbol) and needs.is_free(production, at, limiting[production.lhs]):
                graph.add_edge(production.lhs, symbol)
    circles = nx.strongly_connected_components(graph)
    return frozenset(node for circle in circles for node in circle if len(circle) > 1 or graph.has_edge(node, node))


def ever_open(bound: BoundGrammar) -> dict[int, frozenset[int]]:
    """For each nonterminal, the constraints with a scope open in it on some way from the start."""
    return {lhs: bound.encloses_of(lhs).union(bound.opens_of(lhs)) for lhs in bound.by_lhs}


def _always_open(bound: BoundGrammar, productions: Iterable[Production]) -> dict[int, frozenset[int]]:
    """For each nonterminal, the constraints with a scope open in it on every way from the start."""
    by_lhs = grouped(productions, lambda production: production.lhs)
    found = {bound.start_symbol: frozenset(bound.opens_of(bound.start_symbol))}
    queue = [bound.start_symbol]
    while queue:
        lhs = queue.pop()
        for production in by_lhs.get(lhs, ()):
            for symbol in filter(bound.is_nonterminal, production.rhs):
                inside = found[lhs] | set(bound.opens_of(symbol))
                if symbol not in found or not found[symbol] <= inside:
                    found[symbol] = found.get(symbol, inside) & inside
                    queue.append(symbol)
    return found
