"""Random derivations in which short sub-trees come first."""

from __future__ import annotations

from bisect import bisect_right
from itertools import accumulate
from math import exp

import numpy as np

from grammarbt.grammar import BoundGrammar, Derivation
from grammarbt.search.derivations import Template
from grammarbt.search.states import States, Walk

ENDLESS = 1_000_000


class ShortFirst:
    """Fills the open places of derivations at random.

    A production weighs its own weight times exp(-shortness · the nodes that it needs beyond the least possible).

    Args:
        states: of the grammar.
        shortness: how much less a sub-tree weighs per node.
    """

    def __init__(self, states: States, shortness: float) -> None:
        self.states = states
        rules = states.grammar.productions
        sizes = least_sizes(states.grammar)
        least = {rule.lhs: min(sizes[other.number] for other in states.grammar.by_lhs[rule.lhs]) for rule in rules}
        self._weights = [
            rule.weight * exp(-shortness * (size - least[rule.lhs])) for rule, size in zip(rules, sizes, strict=True)
        ]
        self._bounds: dict[tuple[int, ...], list[float]] = {}

    def sample(self, rng: np.random.Generator) -> Derivation | None:
        """A random derivation of a tree."""
        return self.complete((None,), rng)

    def complete(self, template: Template, rng: np.random.Generator) -> Derivation | None:
        """The template with a random sub-tree in each open place; None if a step is then not legal."""
        walk = self.states.walk()
        for production in template:
            if production is None:
                self._grow(walk, rng)
            elif not walk.take(production):
                return None
        return tuple(walk.derivation)

    def _grow(self, walk: Walk, rng: np.random.Generator) -> None:
        height = len(walk.stack)
        while len(walk.stack) >= height and (state := walk.state):
            walk.take(self._draw(state.productions, rng))

    def _draw(self, productions: tuple[int, ...], rng: np.random.Generator) -> int:
        if len(productions) == 1:
            return productions[0]
        bounds = self._bounds.get(productions)
        if bounds is None:
            bounds = list(accumulate(self._weights[production] for production in productions))
            self._bounds[productions] = bounds
        return productions[bisect_right(bounds, float(rng.random()) * bounds[-1])]


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
