"""Has a language finitely many derivations?"""

from __future__ import annotations

from collections.abc import Iterable

import networkx as nx

from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.table import Production


def is_finite(bound: BoundGrammar, usable: Iterable[Production]) -> bool:
    """Whether no circle of productions can go on for ever.

    Each turn must use up something that a constraint around the whole circle limits.
    """
    productions, needs = tuple(usable), bound.forms.needs
    always = _always_open(bound, productions)
    graph: nx.DiGraph[int] = nx.DiGraph()
    for production in productions:
        for at, symbol in enumerate(production.rhs):
            if bound.is_nonterminal(symbol):
                spent = needs.certain(production, at) & always[production.lhs]
                old = graph.get_edge_data(production.lhs, symbol, {"spent": spent})["spent"]
                graph.add_edge(production.lhs, symbol, spent=old & spent)
    return _ends(graph)


def _ends(graph: nx.DiGraph[int]) -> bool:
    """Whether every path ends: take out the steps that use up one constraint, and look at what is left."""
    queue = [graph]
    while queue:
        part = queue.pop()
        for component in nx.strongly_connected_components(part):
            circle = part.subgraph(component)
            if not circle.number_of_edges():
                continue
            steps: list[tuple[int, int, frozenset[int]]] = list(circle.edges(data="spent"))
            spent = frozenset[int]().union(*(edge for _, _, edge in steps))
            if not spent:
                return False
            rest = circle.copy()
            rest.remove_edges_from([(one, other) for one, other, edge in steps if edge])
            queue.append(rest)
    return True


def _always_open(bound: BoundGrammar, productions: Iterable[Production]) -> dict[int, frozenset[int]]:
    """For each nonterminal, the constraints with a scope open in it on every way from the start."""
    by_lhs: dict[int, list[Production]] = {}
    for production in productions:
        by_lhs.setdefault(production.lhs, []).append(production)
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
