"""Annealing over ordered lists of the sub-trees that a search has met."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import exp
from typing import TypeAlias

import numpy as np
from attrs import frozen

from grammarbt.search import Batches, ListedTree, Piece, Proposal, RootList, Scenarios, Width, pick, piece_of
from grammarbt_dagmcts.experience import Experience, Unit
from grammarbt_dagmcts.parameters import DagMctsParameters

TRIES = 50
"""Changes drawn until one gives another tree of the language."""

Pieces: TypeAlias = tuple[Piece, ...]


@frozen(eq=False)
class Place:
    """A list, and the reward it brought."""

    pieces: Pieces
    reward: float


class ListAnnealing:
    """Swaps, deletes and inserts known sub-trees, one episode per list, and is ever less ready to lose.

    Args:
        lists: puts sub-trees together.
        experience: knows the sub-trees, and learns from every list.
        scenarios: every list has a fresh one.
        rng: randomness.
        parameters: the first temperature, which falls to 0 in a line over a round, and when to go back to the best.
    """

    def __init__(
        self,
        lists: RootList,
        experience: Experience,
        scenarios: Scenarios,
        rng: np.random.Generator,
        parameters: DagMctsParameters,
    ) -> None:
        self.lists = lists
        self.experience = experience
        self.scenarios = scenarios
        self.rng = rng
        self.parameters = parameters
        self.accepted = self.resets = 0
        self._pieces: dict[Unit, Piece] = {}

    def round(self, length: int, width: Width) -> Batches[None]:
        """Anneal for so many episodes, from the best tree so far; over at once where there is nothing to change."""
        known = list(self.experience.subtrees)
        here = best = Place(tuple(self._piece(unit) for unit in self.experience.best), self.experience.highest)
        hottest = self.parameters.heat * self.experience.spread
        spent = idle = 0
        while spent < length and (neighbours := self._neighbours(here.pieces, known, min(width(), length - spent))):
            evaluations = yield [self._proposal(neighbour) for neighbour in neighbours]
            for neighbour, evaluation in zip(neighbours, evaluations, strict=True):
                place = Place(neighbour.pieces, self.experience.learn(evaluation))
                spent += 1
                if self._accepts(place.reward - here.reward, hottest * (1.0 - spent / length)):
                    here = place
                    self.accepted += 1
                idle = 0 if place.reward > best.reward else idle + 1
                best = best if idle else place
            if idle >= self.parameters.reset_after:
                here, idle = best, 0
                self.resets += 1

    def _piece(self, unit: Unit) -> Piece:
        if unit not in self._pieces:
            self._pieces[unit] = piece_of(self.lists.grammar, *unit)
        return self._pieces[unit]

    def _proposal(self, listed: ListedTree) -> Proposal:
        scenario = self.scenarios.fresh(1)
        return Proposal(listed.tree, listed.derivation, scenario, scenario + 1)

    def _accepts(self, gain: float, temperature: float) -> bool:
        if gain >= 0.0:
            return True
        return temperature > 0.0 and float(self.rng.random()) < exp(gain / temperature)

    def _neighbours(self, pieces: Pieces, known: Sequence[Unit], n: int) -> list[ListedTree]:
        found = (self._neighbour(pieces, known) for _ in range(n))
        return [neighbour for neighbour in found if neighbour is not None]

    def _neighbour(self, pieces: Pieces, known: Sequence[Unit]) -> ListedTree | None:
        moves: tuple[Callable[[Pieces, Sequence[Unit]], Pieces], ...] = (self._swap, self._delete, self._insert)
        for _ in range(TRIES if pieces else 0):
            changed = pick(moves, self.rng)(pieces, known)
            listed = None if changed == pieces else self.lists.assemble(changed)
            if listed is not None:
                return listed
        return None

    def _swap(self, pieces: Pieces, known: Sequence[Unit]) -> Pieces:
        del known
        changed = list(pieces)
        one, other = self._below(len(changed)), self._below(len(changed))
        changed[one], changed[other] = changed[other], changed[one]
        return tuple(changed)

    def _delete(self, pieces: Pieces, known: Sequence[Unit]) -> Pieces:
        del known
        at = self._below(len(pieces))
        return pieces[:at] + pieces[at + 1 :]

    def _insert(self, pieces: Pieces, known: Sequence[Unit]) -> Pieces:
        at = self._below(len(pieces) + 1)
        return (*pieces[:at], self._piece(pick(known, self.rng)), *pieces[at:])

    def _below(self, n: int) -> int:
        return int(self.rng.random() * n)
