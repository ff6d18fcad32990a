"""Scores of derivations, for searchers that simulate each tree once or a few times: which scenario next, and the mean."""

from __future__ import annotations

from collections.abc import Sequence
from heapq import nlargest
from math import sqrt
from operator import add

from attrs import define

from grammarbt.bt import BehaviorTree
from grammarbt.grammar import Derivation
from grammarbt.search.bandits import Arm
from grammarbt.search.base import Evaluation, Proposal
from grammarbt.search.batches import Batches, Scenarios
from grammarbt.search.states import States

FEWEST_VALUES = 5
"""Different returns that must each come again in a second scenario before all scenarios are taken to be alike."""

CHECKED_AT_ONCE = 10
MOST_CHECKS = 30
"""Trees simulated twice, at most, to learn that."""


@define(eq=False)
class Score:
    """What is known of a derivation.

    Attributes:
        derivation: leftmost.
        total: the sum of its returns.
        episodes: how many there are.
        last: the last of them.
        failed: its tree could not be simulated.
        ticks: how often each leaf was ticked; empty if unknown.
    """

    derivation: Derivation
    total: float = 0.0
    episodes: int = 0
    last: float = 0.0
    failed: bool = False
    ticks: tuple[int, ...] = ()

    @property
    def mean(self) -> float:
        """Mean return; minus infinity if there is none."""
        return self.total / self.episodes if self.episodes else float("-inf")


class Scorer:
    """Simulates derivations, and remembers what is known of each.

    Trees scored together meet the same scenario, a fresh one every time, so that no tree wins by a lucky world. Where
    all scenarios are alike, nothing is simulated twice.

    Args:
        states: of the grammar.

    Attributes:
        scores: by derivation, in the order tried.
        alike: whether all scenarios are alike; None while that is not known.
        returns: all that were seen.
        low: the lowest of them.
        high: the highest.
    """

    def __init__(self, states: States) -> None:
        self.states = states
        self.scores: dict[Derivation, Score] = {}
        self.alike: bool | None = None
        self.returns = Arm()
        self.low, self.high = float("inf"), float("-inf")
        self._scenarios = Scenarios()
        self._repeated: dict[float, None] = {}
        self._checks = 0

    def score(self, derivations: Sequence[Derivation], scenario: int | None = None) -> Batches[list[Score]]:
        """Simulate each for one episode, unless that would show nothing new; gives what is then known of each."""
        scores = [self.scores.setdefault(derivation, Score(derivation)) for derivation in derivations]
        due = [one for one in dict.fromkeys(scores) if not (one.failed or (self.alike and one.episodes))]
        if due:
            evaluations = yield self._proposals(due, scenario)
            for one, evaluation in zip(due, evaluations, strict=True):
                self._learn(one, evaluation)
        return scores

    def fresh(self, n: int) -> int:
        """The first of n scenarios that were never used."""
        return self._scenarios.fresh(n)

    def is_settled(self, derivation: Derivation) -> bool:
        """Whether another simulation would show nothing new."""
        known = self.scores.get(derivation)
        return known is not None and (known.failed or bool(self.alike and known.episodes))

    def _proposals(self, due: Sequence[Score], scenario: int | None) -> list[Proposal]:
        twice = CHECKED_AT_ONCE if self.alike is None and scenario is None else 0
        start = 0 if self.alike else self.fresh(2 if twice else 1) if scenario is None else scenario
        return [
            Proposal(self.states.tree(one.derivation), one.derivation, start, start + (2 if at < twice else 1))
            for at, one in enumerate(due)
        ]

    def _learn(self, score: Score, evaluation: Evaluation) -> None:
        score.failed = not evaluation.returns
        if evaluation.ticks:
            before = score.ticks or (0,) * len(evaluation.ticks)
            score.ticks = tuple(map(add, before, evaluation.ticks))
        for value in evaluation.returns:
            score.total += value
            score.episodes += 1
            score.last = value
            self.returns.add(value)
            self.low, self.high = min(self.low, value), max(self.high, value)
        if self.alike is None and len(evaluation.returns) > 1:
            self._compare(evaluation.returns)

    def _compare(self, returns: Sequence[float]) -> None:
        """Learn from a tree's returns in two scenarios whether scenarios are alike."""
        self._checks += 1
        self._repeated[returns[0]] = None
        if returns[0] != returns[-1] or (self._checks >= MOST_CHECKS and len(self._repeated) < FEWEST_VALUES):
            self.alike = False
        elif len(self._repeated) >= FEWEST_VALUES:
            self.alike = True

    def reward(self, score: Score) -> float:
        """What a learner may add up: the return of the last episode; the lowest of all for a tree that failed."""
        if score.failed or not score.episodes:
            return self.low if self.returns.visits else 0.0
        return score.last

    def sure(self, score: Score) -> float:
        """The mean less one standard error, with a spread common to all trees."""
        return score.mean - sqrt(self.returns.variance / score.episodes) if score.episodes else float("-inf")

    def best(self, n: int) -> list[BehaviorTree]:
        """The at most n trees that are best for sure, best first."""
        scores = nlargest(2 * n, (one for one in self.scores.values() if one.episodes), key=self.sure)
        return list(dict.fromkeys(self.states.tree(one.derivation) for one in scores))[:n]
