"""The robot and the cubes in plain Python: what the leaves do and ask."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from grammarbt.domain.chance import uniform
from grammarbt_pickplace import constants
from grammarbt_pickplace.program import LEAVES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grammarbt_pickplace.tasks import Point

PLACES = ("pick0", "pick1", "pick2", "place", "spawn", "elsewhere")
POSES: dict[str, tuple[float, float]] = {
    place: (x, y) for place, (x, y) in zip(PLACES, constants.POSES.tolist(), strict=False)
}
FACING: dict[str, tuple[float, float]] = {
    place: (x, y) for place, (x, y) in zip(PLACES, constants.FACING.tolist(), strict=True)
}
GOAL: Point = tuple(constants.GOAL.tolist())
FIRST_ESTIMATE: tuple[float, float] = tuple(constants.FIRST_ESTIMATE.tolist())


class PlainRobot:
    """The robot at the start of a run; `key` makes its chance its own."""

    def __init__(self, starts: Sequence[Point], key: int, stochastic: bool) -> None:
        self.starts, self.key, self.stochastic = starts, key, stochastic
        self.acts, self.time = 0, 0.0
        self.place, self.pose, self.estimate = "spawn", POSES["spawn"], FIRST_ESTIMATE
        self.localised, self.head, self.arm = False, "down", "stretched"
        self.held: int | None = None
        self.visited: set[str] = set()
        self.moving = self.handling = False
        self.cubes = list(starts)
        self.news: list[str] = []
        self._measure()

    def score(self, nodes: int) -> float:
        """The published return for a tree of so many nodes, if the run ended now."""
        to_goal = to_robot = 0.0
        for cube in range(len(self.cubes)):  # one after the other: sum() would round otherwise
            to_goal += self.to_goal[cube]
            to_robot += self.to_robot[cube]
        cost = 0.5 * nodes + 0.1 * self.time
        cost += 10.0 * to_goal * to_goal + self.error * self.error + 2.0 * to_robot * to_robot
        placed = self.to_goal.count(0.0)
        if placed < len(self.cubes):
            cost += 300.0 - 100.0 * placed - (0.0 if self.held is None else 50.0)
        return -cost

    def holds(self, condition: str) -> bool:
        """Whether a condition holds."""
        if condition == "have block":
            return self.held is not None
        if condition == "task done":
            return not any(self.to_goal)
        if condition.startswith("table"):
            return f"pick{condition[5]}" in self.visited
        return self.cubes[int(condition[4])] == GOAL and self.held is None

    def in_effect(self, action: str) -> bool:
        """Whether the action's effect holds, so that its node keeps its answer."""
        if action.startswith("move to "):
            return self.place == action.removeprefix("move to ")
        return {
            "tuck": self.arm == "tucked",
            "pick": self.held is not None,
            "place": self.held is None,
            "localise": self.localised,
            "head up": self.head == "up" or self.handling,
            "head down": self.head == "down" or self.moving,
        }[action]

    def set_at_work(self, action: str, *, at_work: bool) -> None:
        """An action has begun, or is done."""
        if action.startswith("move to "):
            self.moving = at_work
        elif action in {"tuck", "pick", "place"}:
            self.handling = at_work

    def act(self, action: str) -> bool:
        """Do the action, and let its time pass; whether it succeeded."""
        self.set_at_work(action, at_work=False)
        self.acts += 1
        self.time += float(constants.SECONDS[LEAVES.index(action)])
        if action in {"head up", "head down"}:
            self.head = action.removeprefix("head ")
            return True
        success = self._do(action)
        self._update()
        if not success:
            self.news.append(f"{action} failed")
        return success

    def _do(self, action: str) -> bool:
        if action.startswith("move to "):
            return self._move(action.removeprefix("move to "))
        return {"tuck": self._tuck, "pick": self._pick, "place": self._put, "localise": self._localise}[action]()

    def _localise(self) -> bool:
        self.localised = not self._goes_wrong(constants.OUTCOME, constants.LOCALISE_FAILS)
        if self.localised:
            self.news.append("localised")
        return self.localised

    def _tuck(self) -> bool:
        self.arm = "tucked"
        self._lose_cube()
        return True

    def _move(self, place: str) -> bool:
        """Drive to a place; takes the time from where the robot believed to be."""
        x, y = self.estimate
        if self.place != place and self.localised and self.head == "up" and self.arm in {"tucked", "at pick"}:
            self._drive(place)
        self.time += _length(self.pose[0] - x, self.pose[1] - y) / constants.SPEED
        return self.place == place

    def _drive(self, place: str) -> None:
        dropped = self.held is not None and self._goes_wrong(constants.DROPPING, constants.DROPPED)
        lost = self._goes_wrong(constants.LOSING, constants.LOST)
        (x, y), (goal_x, goal_y) = self.estimate, POSES[place]
        if dropped or lost:
            self.place, self.pose = "elsewhere", ((x + goal_x) / 2.0, (y + goal_y) / 2.0)
        else:
            self.place, self.pose = place, (goal_x, goal_y)
            self.news.append(f"at {place}")
        if dropped:
            self._lose_cube()
        if lost:
            self.localised = False
            self.estimate = self._noisy_pose(constants.LOST_ESTIMATE)
            self.news.append("lost its way")

    def _pick(self) -> bool:
        nearest = self.to_robot.index(min(self.to_robot))
        ready = self.localised and self.head == "down" and self.arm == "tucked"
        in_reach = self.place not in {"spawn", "elsewhere"} and self.to_robot[nearest] < constants.REACH
        success = ready and in_reach and not self._goes_wrong(constants.OUTCOME, constants.PICK_FAILS)
        if success:
            self.held, self.arm = nearest, "at pick"
            self.news.append(f"cube {nearest} picked")
        if self.place.startswith("pick"):
            self.visited.add(self.place)
        return success

    def _put(self) -> bool:
        ready = self.localised and self.head == "down" and self.place == "place"
        if self.held is None or not ready or self._goes_wrong(constants.OUTCOME, constants.PLACE_FAILS):
            return False
        self.news.append(f"cube {self.held} placed")
        self.cubes[self.held], self.held, self.arm = GOAL, None, "at place"
        return True

    def _lose_cube(self) -> None:
        """A held cube goes back to its start."""
        if self.held is not None:
            self.news.append(f"cube {self.held} lost")
            self.cubes[self.held], self.held = self.starts[self.held], None

    def _update(self) -> None:
        """Estimate the pose anew, carry a held cube along, and measure all distances."""
        if self.localised:
            self.estimate = self._noisy_pose(constants.ESTIMATE)
        else:
            x, y = self.estimate
            self.estimate = x + 1.5 + self._uniform(constants.ESTIMATE), y + 1.5 + self._uniform(constants.ESTIMATE + 1)
        if self.held is not None:
            x, y = (
                here + 0.3 * ahead + (0.2 * self._uniform(constants.CUBE + axis) - 0.1)
                for axis, (here, ahead) in enumerate(zip(self.pose, FACING[self.place], strict=True))
            )
            self.cubes[self.held] = (x, y, 1.3 + 0.1 * self._uniform(constants.CUBE + 2))
        self._measure()

    def _noisy_pose(self, decides: int) -> tuple[float, float]:
        x, y = self.pose
        return x + 0.1 * self._uniform(decides), y + 0.1 * self._uniform(decides + 1)

    def _measure(self) -> None:
        (x, y), (believed_x, believed_y) = self.pose, self.estimate
        self.error = _length(believed_x - x, believed_y - y)
        self.to_goal = [_length(*(one - goal for one, goal in zip(cube, GOAL, strict=True))) for cube in self.cubes]
        self.to_robot = [_length(cube[0] - x, cube[1] - y) for cube in self.cubes]

    def _goes_wrong(self, decides: int, probability: float) -> bool:
        return self.stochastic and self._uniform(decides) < probability

    def _uniform(self, decides: int) -> float:
        return uniform(self.key + (self.acts << 16) + decides)


def _length(x: float, y: float, z: float = 0.0) -> float:
    return math.sqrt(x * x + y * y + z * z)
