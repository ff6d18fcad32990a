"""The searcher: one derivation that changes, ever more choosy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import log, sqrt

from attrs import define, field

from grammarbt.bt import BehaviorTree
from grammarbt.grammar import Derivation, parse_tree
from grammarbt.search import (
    Batches,
    BatchSearcher,
    IdleElements,
    Moves,
    Score,
    Scorer,
    SearchContext,
    States,
    Width,
    pick,
)
from grammarbt_annealing.parameters import AnnealingParameters

ATTEMPTS = 50
"""Moves tried in search of a neighbour, before a random tree takes its place."""


class Annealing(BatchSearcher):
    """Simulated annealing (Kirkpatrick, Gelatt & Vecchi, Science 1983) over derivations."""

    def __init__(self, context: SearchContext, parameters: AnnealingParameters) -> None:
        super().__init__("annealing", AnnealedSearch(context, parameters))


@define(eq=False)
class Present:
    """The tree that is changed, with its returns on a panel of scenarios, of which `panel` is the first."""

    score: Score
    panel: int
    returns: list[float] = field(factory=list)


class AnnealedSearch:
    """Moves to a neighbour that is better on common scenarios, or worse by no more than chance and heat allow."""

    def __init__(self, context: SearchContext, parameters: AnnealingParameters) -> None:
        self.context = context
        self.parameters = parameters
        self.rng = context.rng
        states = States(context.grammar)
        self.scorer = Scorer(states)
        self.moves = Moves(context.grammar, states)
        self.idle = IdleElements(self.moves)
        self.kinds = (self.moves.regenerate, self.moves.insert, self.moves.delete, self.moves.reorder)
        self.accepted = self.resets = self.steps = 0

    def batches(self, width: Width) -> Batches[None]:
        """Step after step, as many neighbours at a time as the run can use; ends when there are none left."""
        present = best = Present((yield from self._first()), self._panel())
        idle = 0
        while neighbours := self._neighbours(present.score, width()):
            self.steps += 1
            winner = yield from self._compare(present, neighbours)
            if winner is not None:
                self.accepted += 1
                present = Present(winner, self._panel())
            idle = 0 if self.scorer.sure(present.score) > self.scorer.sure(best.score) else idle + 1
            if idle == 0:
                best = present
            elif idle >= self.parameters.reset_after:
                present, idle = Present(best.score, self._panel()), 0
                self.resets += 1

    def _panel(self) -> int:
        """Scenarios that nothing was chosen on."""
        return self.scorer.fresh(self.parameters.episodes)

    def _first(self) -> Batches[Score]:
        """The start tree, if there is one, or the best of some random trees."""
        start = self.context.start
        known = [] if start is None else [parse_tree(self.context.grammar, start)]
        drawn = [self.context.grammar.sample(self.rng) for _ in range(self.parameters.first_trees)]
        scores = yield from self.scorer.score(known + drawn)
        return scores[0] if known else max(scores, key=self.scorer.reward)

    def _neighbours(self, present: Score, n: int) -> list[Derivation]:
        """So many different ones; fewer if they are hard to find."""
        tree = self.moves.tree(present.derivation)
        if self.parameters.trim and present.episodes >= self.parameters.episodes and present.ticks:
            tree = self.idle.removed(tree, present.ticks, self.rng)
        found: dict[Derivation, None] = {}
        for attempt in range(ATTEMPTS * n):
            if len(found) == n:
                break
            if attempt < ATTEMPTS * n // 2:
                derivation = pick(self.kinds, self.rng)(tree, self.rng)
            else:
                derivation = self.context.grammar.sample(self.rng)
            if derivation is not None and not self.scorer.is_settled(derivation):
                found[derivation] = None
        return list(found)

    def _compare(self, present: Present, neighbours: Sequence[Derivation]) -> Batches[Score | None]:
        """Scenario by scenario; gives the best of the neighbours that are acceptable to the last."""
        lost = {neighbour: self.heat * log(1.0 - self.rng.random()) for neighbour in neighbours}
        gains = dict.fromkeys(neighbours, 0.0)
        for stage in range(1 if self.scorer.alike else self.parameters.episodes):
            due = [*gains, *([] if stage < len(present.returns) else [present.score.derivation])]
            scores = yield from self.scorer.score(due, present.panel + stage)
            rewards = [self.scorer.reward(score) for score in scores]
            present.returns += rewards[len(gains) :]
            for neighbour, reward in zip(gains, rewards, strict=False):
                gains[neighbour] += reward - present.returns[stage]
            gains = {own: gain for own, gain in gains.items() if gain / (stage + 1) >= lost[own]}
            if not gains:
                return None
        winner = max(gains, key=lambda own: gains[own])
        idle = gains[winner] == 0.0 and len(winner) > len(present.score.derivation)
        return None if idle else self.scorer.scores[winner]

    @property
    def heat(self) -> float:
        """The temperature, in units of return."""
        done = min(self.scorer.returns.visits / self.context.budget, 1.0)
        hottest, coldest = self.parameters.hottest, self.parameters.coldest
        unit = sqrt(self.scorer.returns.variance) if self.scorer.returns.visits else 0.0
        if self.parameters.cooling == "geometric":
            return float(unit * hottest * (coldest / hottest) ** done)
        return unit * (hottest + done * (coldest - hottest))

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The trees that are best for sure."""
        return self.scorer.best(n)

    def metrics(self) -> Mapping[str, float]:
        """Steps, accepted ones, and returns to the best tree."""
        return {"steps": self.steps, "accepted": self.accepted, "resets": self.resets, "heat": self.heat}
