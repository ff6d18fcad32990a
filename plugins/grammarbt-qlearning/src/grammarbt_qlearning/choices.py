"""What there is to decide in a derivation: unit productions are no decisions of their own."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from grammarbt.grammar import Derivation
from grammarbt.search import State, States

Option: TypeAlias = tuple[int, ...]
"""Unit productions, one after the other, and the production that they lead to."""


class Choices:
    """The options of each state: its legal productions once unit productions are eliminated.

    A unit production gives a nonterminal another name, as in `program: ACTION`. As a decision of its own it would leave
    the next one with no more than that name: which action comes could no longer depend on where it stands.

    Args:
        states: of the grammar.
    """

    def __init__(self, states: States) -> None:
        self.states = states
        self._unit = tuple(
            len(production.rhs) == len(parts) == 1
            for production, parts in zip(states.grammar.productions, states.parts, strict=True)
        )
        self._known: dict[State, tuple[Option, ...]] = {}

    def options(self, state: State) -> tuple[Option, ...]:
        """All of them, in the grammar's order; no option is the beginning of another."""
        known = self._known.get(state)
        if known is None:
            known = tuple(option for production in state.productions for option in self._from(state, production))
            self._known[state] = known
        return known

    def _from(self, state: State, production: int) -> list[Option]:
        renamed = self._renamed(state, production)
        return [(production, *rest) for rest in self.options(renamed)] if renamed else [(production,)]

    def first(self, state: State, steps: Derivation) -> Option:
        """The option with which the steps begin."""
        return next(option for option in self.options(state) if steps[: len(option)] == option)

    def draw(self, state: State, rng: np.random.Generator) -> Option:
        """An option, by the weights of its productions."""
        drawn: list[int] = []
        now: State | None = state
        while now is not None:
            drawn.append(now.draw(rng))
            now = self._renamed(now, drawn[-1])
        return tuple(drawn)

    def lowest(self, state: State) -> Option:
        """The option that leads to the lowest sub-tree."""
        heights = self.states.heights
        return min(self.options(state), key=lambda option: len(option) + heights[option[-1]])

    def _renamed(self, state: State, production: int) -> State | None:
        """What a unit production leads to."""
        if not self._unit[production]:
            return None
        return (state.steps.get(production) or self.states.step(state, production)).down
