"""First generations: position-independent grow, and sensible initialisation."""

from __future__ import annotations

from functools import cached_property
from typing import Literal, TypeAlias

import networkx as nx
import numpy as np

from grammarbt.grammar import Derivation, SententialForm
from grammarbt.search import States, leftmost, pick

InitialiseName: TypeAlias = Literal["pi-grow", "sensible", "random"]


class Initialiser:
    """Makes derivations of ramped depths.

    * `pi-grow`: any open nonterminal may be next, and the last that can still grow does so until the depth is reached
      (Fagan, Fenton & O'Neill, "Exploring Position Independent Initialisation in Grammatical Evolution", CEC 2016).
    * `sensible`: leftmost; half of them grow, half are as full as the depth allows (Ryan & Azad, "Sensible
      Initialisation in Grammatical Evolution", GECCO 2003).
    * `random`: leftmost by the productions' weights, without a depth.

    Args:
        states: of the grammar.
        depth: of the deepest derivation tree, counted above the lowest possible.
        rng: chance.
    """

    def __init__(self, states: States, depth: int, rng: np.random.Generator) -> None:
        self.states = states
        self.grammar = states.grammar
        self.depth = depth
        self.rng = rng

    def derivations(self, name: InitialiseName, n: int) -> list[Derivation]:
        """So many of them, shallow ones first."""
        if name == "random":
            return [self.grammar.sample(self.rng) for _ in range(n)]
        heights = self.states.heights
        lowest = min(heights[production.number] for production in self.grammar.by_lhs[self.grammar.start_symbol])
        limits = [lowest + 1 + at * self.depth // n for at in range(n)]
        if name == "pi-grow":
            return [self._grown(limit, anywhere=True, full=False) for limit in limits]
        return [self._grown(limit, anywhere=False, full=at % 2 == 1) for at, limit in enumerate(limits)]

    def _grown(self, limit: int, *, anywhere: bool, full: bool) -> Derivation:
        """A derivation whose tree is no deeper than the limit, as far as the constraints leave that choice."""
        form, depths = self.grammar.start(), [1]
        steps: list[tuple[SententialForm, int, int]] = []
        while depths:
            at = int(self.rng.random() * len(depths)) if anywhere else 0
            position = self.grammar.positions(form)[at]
            last = full or (anywhere and len(depths) == 1)
            production = self._choice(self.grammar.legal(form, position), limit - depths[at] + 1, grow_on=last)
            steps.append((form, position, production))
            form = self.grammar.apply(form, production, position)
            depths[at : at + 1] = [depths[at] + 1] * len(self.states.parts[production])
        return tuple(production for production in leftmost(self.grammar, steps) if production is not None)

    def _choice(self, legal: tuple[int, ...], left: int, *, grow_on: bool) -> int:
        """A production that can end within the levels left; a recursive one if there is to be more."""
        heights = self.states.heights
        fitting = [production for production in legal if heights[production] <= left]
        recursive = [production for production in fitting if production in self._recursive] if grow_on else []
        lowest = min(heights[production] for production in legal)
        return pick(
            recursive or fitting or [production for production in legal if heights[production] == lowest], self.rng
        )

    @cached_property
    def _recursive(self) -> frozenset[int]:
        """Productions from which their left-hand side can be reached again."""
        productions = self.grammar.productions
        graph = nx.DiGraph((own.lhs, part) for own in productions for part in self.states.parts[own.number])
        below = {symbol: nx.descendants(graph, symbol) | {symbol} for symbol in graph}
        return frozenset(
            own.number for own in productions if any(own.lhs in below[part] for part in self.states.parts[own.number])
        )
