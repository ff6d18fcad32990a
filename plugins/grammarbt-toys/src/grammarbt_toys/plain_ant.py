"""The ant in plain Python: to compare with, and to watch; the rules of time are told in `ant_kernel.py`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import pi

from grammarbt.bt import Leaf, Status
from grammarbt.domain import Mark
from grammarbt.domain.plain import EpisodeOverError

_ANGLES = {(0, 1): 0.0, (-1, 0): pi / 2, (0, -1): pi, (1, 0): -pi / 2}
"""By the cells that it goes down and to the right."""


class PlainAnt:
    """An ant at (0, 0), facing east, on a trail drawn as rows of text, with `#` for a pellet."""

    def __init__(self, rows: Sequence[str], steps: int) -> None:
        self.rows, self.columns, self.steps = len(rows), len(rows[0]), steps
        self.pellets = [
            (row, column) for row, line in enumerate(rows) for column, sign in enumerate(line) if sign == "#"
        ]
        self.food = set(self.pellets)
        self.place, self.heading, self.time = (0, 0), (0, 1), 0
        self._began, self._seen = 0, 0

    @property
    def box(self) -> tuple[float, float, float, float]:
        """A unit for each cell."""
        return -1.0, -1.0, float(self.columns), float(self.rows)

    @property
    def reward(self) -> float:
        """The pellets eaten."""
        return float(len(self.pellets) - len(self.food))

    @property
    def done(self) -> bool:
        """Whether the steps are over."""
        return self.time >= self.steps

    def answer(self, leaf: Leaf, _: int) -> Status:
        """Look ahead, or take a step."""
        if self.done:
            raise EpisodeOverError
        (row, column), (down, right) = self.place, self.heading
        ahead = (row + down) % self.rows, (column + right) % self.columns
        if leaf.name == "food ahead":
            return Status.SUCCESS if ahead in self.food else Status.FAILURE
        self.time += 1
        if leaf.name == "move forward":
            self.place = ahead
            self.food.discard(ahead)
        else:
            self.heading = (right, -down) if leaf.name == "turn right" else (-right, down)
        return Status.SUCCESS

    def step(self, _: Status | None) -> None:
        """A tick in which nothing took a step costs one."""
        self.time += self.time == self._began
        self._began = self.time

    def picture(self) -> Sequence[Mark]:
        """The torus, the pellets, and the ant; what is eaten cannot be seen."""
        return tuple(self._draw())

    def events(self) -> Sequence[str]:
        """How many pellets were eaten since."""
        eaten, self._seen = int(self.reward) - self._seen, int(self.reward)
        return (f"{eaten} eaten",) if eaten else ()

    def _draw(self) -> Iterator[Mark]:
        middle_x, middle_y = (self.columns - 1) / 2, (self.rows - 1) / 2
        yield Mark("torus", "square", "ground", middle_x, middle_y, max(self.columns, self.rows), 0.1)
        for row, column in self.pellets:
            left = float((row, column) in self.food)
            yield Mark(f"pellet {row},{column}", "circle", "object", column, self.rows - 1 - row, 0.5, left)
        row, column = self.place
        yield Mark("ant", "triangle", "robot", column, self.rows - 1 - row, 1.0, angle=_ANGLES[self.heading])
