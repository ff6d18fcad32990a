"""The final selection: the searcher's candidates race on scenarios that none of them was chosen on."""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, log2
from typing import TYPE_CHECKING

from attrs import frozen

from grammarbt.run.evaluate import Evaluator, Trial
from grammarbt.search import Proposal

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grammarbt.bt import BehaviorTree

FIRST_SELECTION_SCENARIO = 2**30
"""Searching uses the scenarios below, selecting those from it on."""

MAX_CANDIDATES = 32


@frozen(eq=False)
class SuccessiveHalving:
    """Sequential halving (Karnin, Koren & Somekh, ICML 2013) on common scenarios.

    Every round simulates the same number of episodes, shared equally among the trees left; the better half goes on.

    Args:
        evaluator: simulates.
        record: told of every trial.
    """

    evaluator: Evaluator
    record: Callable[[Trial], None]

    def best(self, candidates: Sequence[BehaviorTree], budget: int) -> BehaviorTree:
        """The winner among the candidates, best first, for at most `budget` episodes; the first on a tie."""
        trees = self._distinct(candidates)
        while len(trees) > 1 and budget // _rounds(len(trees)) < len(trees):
            trees = trees[: len(trees) // 2]
        rounds, first = _rounds(len(trees)), FIRST_SELECTION_SCENARIO
        each = budget // rounds if rounds else 0
        end = self.evaluator.episodes + budget
        while len(trees) > 1:
            last = first + each // len(trees)
            trees = self._better_half(trees, last, end - self.evaluator.episodes)
            first = last
        return trees[0]

    def _distinct(self, trees: Sequence[BehaviorTree]) -> list[BehaviorTree]:
        found: dict[bytes, BehaviorTree] = {}
        for tree in trees:
            found.setdefault(self.evaluator.key(tree), tree)
        return list(found.values())

    def _better_half(self, trees: list[BehaviorTree], stop: int, left: int) -> list[BehaviorTree]:
        # Earlier rounds' scenarios come from the cache, so a mean is over all that the selection knows.
        proposals = [Proposal(tree, None, FIRST_SELECTION_SCENARIO, stop) for tree in trees]
        end = self.evaluator.episodes + left
        # What failed there is simulated again, so the budget may end before the last of them.
        trials = self._evaluated(proposals, left)
        means = [
            trial.evaluation.mean if trial.evaluation.returns else self._mean_one_by_one(proposal, end)
            for proposal, trial in zip(proposals, trials, strict=False)
        ]
        ranked = sorted(range(len(means)), key=lambda at: -means[at])
        return [trees[at] for at in ranked[: ceil(len(trees) / 2)]] or trees[:1]

    def _mean_one_by_one(self, proposal: Proposal, end: int) -> float:
        """The mean of a tree that failed on some of its scenarios: over the others, as far as the budget goes."""
        single = [Proposal(proposal.tree, None, at, at + 1) for at in range(proposal.start, proposal.stop)]
        trials = self._evaluated(single, end - self.evaluator.episodes)
        returns = [value for trial in trials for value in trial.evaluation.returns]
        return sum(returns) / len(returns) if returns else float("-inf")

    def _evaluated(self, proposals: Sequence[Proposal], left: int) -> list[Trial]:
        trials = self.evaluator.evaluate(proposals, left)
        for trial in trials:
            self.record(trial)
        return trials


def _rounds(trees: int) -> int:
    return ceil(log2(trees)) if trees > 1 else 0
