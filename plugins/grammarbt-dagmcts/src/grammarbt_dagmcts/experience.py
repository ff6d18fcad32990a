"""What all roll-outs brought: the best trees, and the sub-trees that these were made of."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from grammarbt.grammar import BoundGrammar, Derivation
from grammarbt.search import Arm, Evaluation, HallOfFame, block_derivations

Unit: TypeAlias = tuple[int, Derivation]
"""A sub-tree: its block, and how it is derived from it."""


class Experience:
    """Outlives restarts.

    Attributes:
        fame: the best trees.
        subtrees: per sub-tree, the returns of the trees that it was in.
        best: the sub-trees of the tree with the highest return, left to right; empty before the first.
        highest: that return.
    """

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self.fame = HallOfFame()
        self.subtrees: dict[Unit, Arm] = {}
        self.best: Sequence[Unit] = ()
        self.highest = float("-inf")
        self._worst = 0.0

    @property
    def spread(self) -> float:
        """Standard deviation of the returns."""
        return float(self.fame.observed.variance**0.5) if self.fame.observed.visits else 0.0

    def learn(self, evaluation: Evaluation) -> float:
        """Remember how a tree did; gives its reward, the worst so far if the evaluation failed."""
        if evaluation.returns:
            self._worst = min(self._worst, evaluation.mean)
        reward = evaluation.mean if evaluation.returns else self._worst
        self.fame.observed.add(reward)
        self.fame.add(evaluation.proposal.tree, evaluation.returns)
        units = block_derivations(self.grammar, evaluation.proposal.derivation or ())
        for unit in dict.fromkeys(units):
            arm = self.subtrees.get(unit)
            if arm is None:
                arm = self.subtrees[unit] = Arm()
            arm.add(reward)
        if evaluation.mean > self.highest:
            self.best, self.highest = units, reward
        return reward

    def promising(self, n: int) -> Sequence[Unit]:
        """The n sub-trees with the best mean return of the trees they were in, less one standard error."""
        spread = self.spread
        ranked = sorted(self.subtrees.items(), key=lambda item: spread / item[1].visits ** 0.5 - item[1].mean)
        return [unit for unit, _ in ranked[:n]]

    def extended(self, n: int) -> BoundGrammar:
        """The grammar with the n most promising sub-trees as productions."""
        grammar = self.grammar
        chosen = self.promising(n)
        for block in dict.fromkeys(block for block, _ in chosen):
            grammar = grammar.extended(block, [derivation for other, derivation in chosen if other == block])
        return grammar
