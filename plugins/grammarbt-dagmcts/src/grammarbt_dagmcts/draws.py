"""Random numbers, drawn many at a time: one by one they cost more than what is done with them."""

from __future__ import annotations

import numpy as np

DRAWN_AT_ONCE = 1_024


class Draws:
    """Hands out numbers from 0 to 1, evenly spread.

    Attributes:
        left: those that are drawn already; taken from its end.
    """

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng
        self.left: list[float] = []

    def ready(self, n: int) -> list[float]:
        """What is left, once there are n at least."""
        while len(self.left) < n:
            self.left[:0] = self._rng.random(DRAWN_AT_ONCE).tolist()
        return self.left

    def below(self, n: int) -> int:
        """A number from 0 to n - 1, all equally likely."""
        return int(self.ready(1).pop() * n)
