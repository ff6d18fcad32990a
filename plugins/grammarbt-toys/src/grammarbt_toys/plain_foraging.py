"""Swarm foraging in plain Python: to compare with, and to watch; the rules of time are told in `foraging_kernel.py`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from grammarbt.bt import Status
from grammarbt.domain import Mark
from grammarbt.domain.chance import mix, uniform
from grammarbt_toys.foraging_world import PLACING
from grammarbt_toys.plain_forager import DIRECTIONS, Cell, Forager, distance

if TYPE_CHECKING:
    from grammarbt.bt import Leaf
    from grammarbt_toys.parameters import ForagingParameters


class PlainForaging:
    """One episode; each tick is one robot's."""

    def __init__(self, parameters: ForagingParameters, scenario: int) -> None:
        self.parameters, self.time, self.delivered = parameters, 0, 0
        self._key, self._item = mix(scenario), PLACING
        self.hub = (parameters.size // 2, parameters.size // 2)
        self.robots = [self._placed_robot(number) for number in range(parameters.robots)]
        self.sites = [self._drawn_cell(parameters.size // 4) for _ in range(parameters.sites)]
        self.food = Counter(site for site in self.sites for _ in range(parameters.food))
        self.news: list[str] = []
        self.time = 1
        self._turn(0)

    @property
    def reward(self) -> float:
        """The pieces of food at the hub."""
        return float(self.delivered)

    @property
    def box(self) -> tuple[float, float, float, float]:
        """A unit for each cell."""
        return -1.0, -1.0, float(self.parameters.size), float(self.parameters.size)

    @property
    def done(self) -> bool:
        """Whether the steps are over."""
        return self.time > self.parameters.steps

    def answer(self, leaf: Leaf, _: int) -> Status:
        """What the robot whose turn it is does or sees."""
        return self.robots[self._active].answer(leaf)

    def step(self, _: Status | None) -> None:
        """The next robot's turn; after the last one, the next step."""
        following = (self._active + 1) % len(self.robots)
        self.time += following == 0
        self._turn(following)

    def events(self) -> Sequence[str]:
        """What was picked up, dropped and delivered since."""
        news, self.news = self.news, []
        return news

    def picture(self) -> Sequence[Mark]:
        """The area with its hub, its sites and its food, and the swarm."""
        return (*self._ground(), *self._pieces(), *(robot.mark(self._y(robot.place[0])) for robot in self.robots))

    def chance(self, item: int) -> float:
        """A number from 0 to below 1 for one decision of this step."""
        return uniform(self._key + (self.time << 24) + item)

    def add_food(self, cell: Cell) -> None:
        """Lay a piece down."""
        self.food[cell] += 1

    def take_food(self, cell: Cell) -> None:
        """Pick a piece up."""
        self.food[cell] -= 1

    def has_food(self, cell: Cell) -> bool:
        """Whether a piece lies there."""
        return self.food[cell] > 0

    def _turn(self, robot: int) -> None:
        self._active = robot
        self.robots[robot].begin_turn()

    def _placed_robot(self, number: int) -> Forager:
        heading = DIRECTIONS[int(self.chance(number) * len(DIRECTIONS))]
        return Forager(self, number, self._drawn_cell(0), heading)

    def _drawn_cell(self, least: int) -> Cell:
        """Draw a cell that is so far from the hub."""
        while True:
            row, column = (int(self.chance(self._item + axis) * self.parameters.size) for axis in (0, 1))
            self._item += 2
            if distance((row, column), self.hub) >= least:
                return row, column

    def _ground(self) -> Iterator[Mark]:
        size = self.parameters.size
        yield Mark("area", "square", "ground", (size - 1) / 2, (size - 1) / 2, size, 0.1)
        yield Mark("hub", "square", "goal", self.hub[1], self._y(self.hub[0]), 3.0, 0.5, "hub")
        for number, (row, column) in enumerate(self.sites):
            yield Mark(f"site {number + 1}", "square", "place", column, self._y(row), 2.0, 0.5, "site")

    def _pieces(self) -> Iterator[Mark]:
        """A mark for every cell that ever held food."""
        for (row, column), count in self.food.items():
            label = str(count) if count > 1 else ""
            yield Mark(f"food {row},{column}", "circle", "object", column, self._y(row), 0.8, float(count > 0), label)

    def _y(self, row: int) -> int:
        return self.parameters.size - 1 - row
