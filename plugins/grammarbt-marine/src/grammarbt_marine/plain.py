"""The simulator again, in plain Python: to read, to compare with, and to watch, as it says what happens.

It shares the tables of roadmaps and rules with the compiled simulator, so that both add the same floating-point
numbers, and nothing else; the rules themselves are told in `kernel`.
"""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Protocol

from grammarbt.bt import Status, flatten
from grammarbt.domain.chance import mix
from grammarbt_marine.layouts import DROP_OFF
from grammarbt_marine.plain_robot import PLACING, PlainRobot
from grammarbt_marine.state import MINE, OBJECT, TARGET

if TYPE_CHECKING:
    import numpy as np

    from grammarbt.bt import BehaviorTree, FlatTree
    from grammarbt_marine.domain import Marine


class Watcher(Protocol):
    """Is told of an episode what cannot be seen afterwards."""

    def answered(self, robot: PlainRobot, occurrence: int, status: Status) -> None:
        """A leaf has answered."""

    def ended(self, robot: PlainRobot) -> None:
        """A robot's tick is over, and so is what it led to."""


class PlainMarine:
    """Simulates trees on the roadmaps and rules of a `Marine` domain."""

    def __init__(self, domain: Marine) -> None:
        self._roadmaps = domain.roadmaps
        self._rules = _table(domain.rules[0])
        self._robots = domain.parameters.robots
        self._tables: dict[int, Any] = {}

    def simulate(self, tree: BehaviorTree, scenarios: Sequence[int]) -> tuple[list[float], list[int]]:
        """The returns of the episodes, and how often each leaf was ticked in all of them."""
        flat = flatten(tree)
        counter = _Counter([0] * flat.occurrences)
        returns = [self.episode(int(scenario)).run(flat, counter) for scenario in scenarios]
        return returns, counter.ticks

    def episode(self, scenario: int) -> PlainEpisode:
        """An episode about to begin."""
        number = scenario % len(self._roadmaps)
        roadmap = self._tables.setdefault(number, _table(self._roadmaps[number]))
        return PlainEpisode(roadmap, self._rules, self._robots, scenario)


class PlainEpisode:
    """A team at sea; `roadmap` and `rules` have the fields of `Roadmap` and `Rules`, as numbers and lists."""

    def __init__(self, roadmap: Any, rules: Any, robots: int, scenario: int) -> None:  # noqa: ANN401 - records have no type
        self.roadmap, self.rules, self.key = roadmap, rules, mix(scenario)
        self.step, self.reward = 0, 0.0
        self.content: dict[int, int] = {}
        self.disarmed: set[int] = set()
        self.reported: set[int] = set()
        self.robots = [PlainRobot(self, number) for number in range(robots)]
        self._fill()
        for robot in self.robots:
            robot.sense()

    def run(self, flat: FlatTree, watcher: Watcher) -> float:
        """Play the episode to its end; gives the return."""
        while self.step < self.rules.horizon:
            for robot in self.robots:
                robot.take_step(flat, watcher)
            self.pass_step()
            for robot in self.robots:
                if robot.entry < 0 or self.step == self.rules.horizon:
                    watcher.ended(robot)
        return self.reward

    def pass_step(self) -> None:
        """Let the time of a step pass."""
        self.step += 1
        for robot in self.robots:
            robot.sense()

    def _fill(self) -> None:
        free = list(range(DROP_OFF + 1, len(self.roadmap.degree)))
        kinds = [kind for kind in (TARGET, MINE, OBJECT) for _ in range(self.roadmap.count[kind])]
        for place, kind in enumerate(kinds):
            other = place + int(self.robots[0].chance(PLACING, place) * (len(free) - place))
            free[place], free[other] = free[other], free[place]
            self.content[free[place]] = kind


class _Counter:
    """Counts how often each leaf of the tree is ticked."""

    def __init__(self, ticks: list[int]) -> None:
        self.ticks = ticks

    def answered(self, _: PlainRobot, occurrence: int, __: Status) -> None:
        self.ticks[occurrence] += 1

    def ended(self, robot: PlainRobot) -> None:
        pass


def _table(record: np.void) -> SimpleNamespace:
    """A record's fields as attributes, its arrays as lists, which plain Python reads faster."""
    names = record.dtype.names or ()
    return SimpleNamespace(**{name: record[name].tolist() for name in names})
