"""The simulator in plain Python: to compare with, and to watch; the rules are told in `kernel/__init__.py`.

It walks the tree leaf by leaf and shares with the compiled simulator only the task and the published numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from attrs import define

from grammarbt.bt import Condition, Leaf, Status, leaves, walk
from grammarbt.domain.chance import mix
from grammarbt_pickplace.constants import ENOUGH_SUCCESSES, MAX_FAILURES, MAX_TICKS
from grammarbt_pickplace.picture import draw
from grammarbt_pickplace.plain_robot import PlainRobot

if TYPE_CHECKING:
    from grammarbt.bt import BehaviorTree
    from grammarbt.domain import Mark
    from grammarbt_pickplace.tasks import Task


@define
class Memory:
    """What an action node remembers: its last answer, None where it is to begin, and when that was last RUNNING."""

    status: Status | None = None
    was_running: int = -1


class PlainPickPlace:
    """One episode: a run for each entry of the task's `starts`, one after the other."""

    _successes: int

    def __init__(self, task: Task, tree: BehaviorTree, scenario: int, *, stochastic: bool = False) -> None:
        self._task, self._key, self._stochastic = task, mix(scenario), stochastic
        self._nodes, self._occurrences = sum(1 for _ in walk(tree)), len(leaves(tree))
        self._runs, self._before = 0, 0.0
        self.done = False
        self._begin_run()

    @property
    def reward(self) -> float:
        """The mean score of the runs so far."""
        return (self._before + self.robot.score(self._nodes)) / self._runs

    def answer(self, leaf: Leaf, occurrence: int) -> Status:
        """Ask a condition, or tick an action node."""
        if self._over:
            self._before += self.robot.score(self._nodes)
            self._begin_run()
        if isinstance(leaf, Condition):
            return Status.SUCCESS if self.robot.holds(leaf.name) else Status.FAILURE
        return self._act(leaf.name, self._memories[occurrence])

    def step(self, status: Status | None) -> None:
        """Count how the tick ended; after the last run the episode is over."""
        self._failures += status is Status.FAILURE
        self._successes = self._successes + 1 if status is Status.SUCCESS else 0
        decided = self._failures == MAX_FAILURES or self._successes == ENOUGH_SUCCESSES
        self._over = decided or self._tick == MAX_TICKS
        self.done = self._over and self._runs == len(self._task.starts)
        self._tick += 1

    def picture(self) -> Sequence[Mark]:
        """Tables, goal, cubes and robot."""
        return draw(self.robot)

    def events(self) -> Sequence[str]:
        """What was done since, and what came of it."""
        news, self.robot.news = self.robot.news, []
        return news

    def _begin_run(self) -> None:
        self.robot = PlainRobot(self._task.starts[self._runs], self._key + (self._runs << 48), self._stochastic)
        self._memories = [Memory() for _ in range(self._occurrences)]
        self._tick, self._failures, self._successes, self._over = 1, 0, 0, False
        self._runs += 1

    def _act(self, action: str, memory: Memory) -> Status:
        if memory.was_running != self._tick - 1 and not self.robot.in_effect(action):
            memory.status = None
        if memory.status is None:
            self.robot.set_at_work(action, at_work=True)
            memory.status = Status.RUNNING
        elif memory.status is Status.RUNNING:
            memory.status = Status.SUCCESS if self.robot.act(action) else Status.FAILURE
        if memory.status is Status.RUNNING:
            memory.was_running = self._tick
        return memory.status
