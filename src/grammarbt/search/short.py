"""Random derivations in which short sub-trees come first."""

from __future__ import annotations

from bisect import bisect_right
from itertools import accumulate
from math import exp

import numpy as np

from grammarbt.grammar import Derivation
from grammarbt.search.derivations import Template
from grammarbt.search.leastsizes import least_sizes
from grammarbt.search.states import States, Walk
from grammarbt.search.tally import CLOSE, Place, Scope, Tally

QUICK_DRAWS = 4
"""Productions drawn regardless of what fits, before all are looked through."""
LONGEST = 2_000
"""Steps after which a sub-tree is given up."""


class ShortFirst:
    """Fills the open places of derivations at random.

    A production weighs its own weight times exp(-shortness · the nodes that it needs beyond the least possible).

    Args:
        states: of the grammar.
        shortness: how much less a sub-tree weighs per node.
    """

    def __init__(self, states: States, shortness: float) -> None:
        self.states = states
        self.grammar = states.grammar
        sizes = least_sizes(self.grammar)
        self._weights = [
            rule.weight * exp(-shortness * (size - min(sizes[other.number] for other in self.grammar.by_lhs[rule.lhs])))
            for rule, size in zip(self.grammar.productions, sizes, strict=True)
        ]
        self._bounds: dict[tuple[int, ...], list[float]] = {}
        self._own = {lhs: tuple(rule.number for rule in own) for lhs, own in self.grammar.by_lhs.items()}
        self._tally = None if self.grammar.depth_constraints else Tally(self.grammar)

    def sample(self, rng: np.random.Generator) -> Derivation:
        """A random derivation of a tree."""
        walk = self.states.walk()
        self._walk(walk, rng)
        return tuple(walk.derivation)

    def complete(self, template: Template, rng: np.random.Generator) -> Derivation | None:
        """The template with a random sub-tree in each open place; None if it breaks a constraint, or that is likely to."""
        if self._tally is None:
            return self._walked(template, rng)
        places = self._tally.places(template)
        if places is None:
            return None
        found: list[int] = []
        ahead = iter(places)
        for production in template:
            if production is not None:
                found.append(production)
            elif not self._grow(self._tally, next(ahead), found, rng):
                return None
        return tuple(found)

    def _grow(self, tally: Tally, place: Place, found: list[int], rng: np.random.Generator) -> bool:
        """Add a sub-tree to what was found; False at a dead end."""
        pending, scopes = [place.symbol], place.scopes
        while pending and len(found) < LONGEST:
            symbol = pending.pop()
            if symbol == CLOSE:
                scopes = scopes[:-1]
                continue
            scope = tally.opened(symbol)
            if scope is not None:
                scopes = (*scopes, scope)
                pending.append(CLOSE)
            production = self._fitting(tally, symbol, scopes, rng)
            if production is None:
                return False
            tally.charge(scopes, production)
            found.append(production)
            pending += self.grammar.parts[production][::-1]
        return not pending

    def _fitting(self, tally: Tally, symbol: int, scopes: tuple[Scope, ...], rng: np.random.Generator) -> int | None:
        own = self._own[symbol]
        for _ in range(QUICK_DRAWS):
            production = self._draw(own, rng)
            if tally.fits(scopes, production):
                return production
        fitting = tuple(production for production in own if tally.fits(scopes, production))
        return self._among(fitting, rng) if fitting else None

    def _draw(self, productions: tuple[int, ...], rng: np.random.Generator) -> int:
        if len(productions) == 1:
            return productions[0]
        bounds = self._bounds.get(productions)
        if bounds is None:
            bounds = list(accumulate(self._weights[production] for production in productions))
            self._bounds[productions] = bounds
        return productions[bisect_right(bounds, float(rng.random()) * bounds[-1])]

    def _among(self, productions: tuple[int, ...], rng: np.random.Generator) -> int:
        """A draw that is not prepared for the next time: subsets are too many to keep."""
        bounds = list(accumulate(self._weights[production] for production in productions))
        return productions[min(bisect_right(bounds, float(rng.random()) * bounds[-1]), len(productions) - 1)]

    # Where depth is limited, the states of leftmost derivations say what is legal.

    def _walked(self, template: Template, rng: np.random.Generator) -> Derivation | None:
        walk = self.states.walk()
        for production in template:
            if walk.state is None:
                return None
            if production is None:
                self._walk(walk, rng)
            elif not walk.take(production):
                return None
        return tuple(walk.derivation) if walk.state is None else None

    def _walk(self, walk: Walk, rng: np.random.Generator) -> None:
        height = len(walk.stack)
        while len(walk.stack) >= height and (state := walk.state):
            walk.take(self._draw(state.productions, rng))
