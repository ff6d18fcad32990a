"""The best tree so far, judged with due suspicion of lucky single episodes."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from attrs import define, field

from grammarbt.bt import BehaviorTree

if TYPE_CHECKING:
    from collections.abc import Sequence

_DOUBT = 3.0


@define
class Incumbent:
    """Keeps the tree whose mean return is highest after `_DOUBT` standard errors are taken off.

    The spread is that of all returns seen, since most trees have been simulated once only.

    Attributes:
        tree: the best tree, None before the first good evaluation.
        mean: its mean return.
        episodes: over how many episodes.
    """

    tree: BehaviorTree | None = None
    mean: float = float("-inf")
    episodes: int = 0
    _count: int = field(default=0, init=False)
    _average: float = field(default=0.0, init=False)
    _squares: float = field(default=0.0, init=False)

    def consider(self, tree: BehaviorTree, returns: Sequence[float], fresh: Sequence[float]) -> None:
        """Compare a tree, given all its returns, of which `fresh` were not seen before."""
        for value in fresh:
            self._note(value)
        mean, episodes = sum(returns) / len(returns), len(returns)
        if self.tree in (None, tree) or self._cautious(mean, episodes) > self._cautious(self.mean, self.episodes):
            self.tree, self.mean, self.episodes = tree, mean, episodes

    def _note(self, value: float) -> None:
        # Welford's update of a mean and a sum of squared differences
        self._count += 1
        difference = value - self._average
        self._average += difference / self._count
        self._squares += difference * (value - self._average)

    def _cautious(self, mean: float, episodes: int) -> float:
        return mean - _DOUBT * sqrt(self._squares / self._count / episodes)
