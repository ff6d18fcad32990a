"""The best tree so far, judged with due suspicion of lucky single episodes."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from attrs import define

from grammarbt.bt import BehaviorTree, parse

if TYPE_CHECKING:
    from collections.abc import Sequence

_DOUBT = 3.0


@define
class Incumbent:
    """Keeps the tree whose mean return is highest after `_DOUBT` standard errors are taken off.

    The spread is that of all returns seen, since most trees have been simulated once only.

    Attributes:
        text: the best tree in the one-line notation, empty before the first good evaluation.
        mean: its mean return.
        episodes: over how many episodes.
        count, average, squares: of all returns seen, their number, mean and sum of squared differences from it.
    """

    text: str = ""
    mean: float = float("-inf")
    episodes: int = 0
    count: int = 0
    average: float = 0.0
    squares: float = 0.0

    @property
    def tree(self) -> BehaviorTree | None:
        """The best tree, None before the first good evaluation."""
        return parse(self.text) if self.text else None

    def consider(self, text: str, mean: float, episodes: int, fresh: Sequence[float]) -> bool:
        """Compare a tree.

        Args:
            text: the tree.
            mean: of all its returns.
            episodes: how many these are.
            fresh: those of them that were not seen before.

        Returns:
            Whether it has taken another's place.
        """
        for value in fresh:
            self._note(value)
        better = text != self.text and self._cautious(mean, episodes) > self._cautious(self.mean, self.episodes)
        if better or text == self.text:
            self.text, self.mean, self.episodes = text, mean, episodes
        return better

    def _note(self, value: float) -> None:
        # Welford's update of a mean and a sum of squared differences
        self.count += 1
        difference = value - self.average
        self.average += difference / self.count
        self.squares += difference * (value - self.average)

    def _cautious(self, mean: float, episodes: int) -> float:
        return mean - _DOUBT * sqrt(self.squares / self.count / episodes) if episodes else mean
