"""The picture of a run: tables, goal, cubes, the robot and where it believes to be; lengths in metres."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from grammarbt.domain import Mark
from grammarbt_pickplace.plain_robot import FACING, GOAL
from grammarbt_pickplace.tasks import CUBES

if TYPE_CHECKING:
    from grammarbt_pickplace.plain_robot import PlainRobot

BOX = (-4.0, -13.0, 5.0, 1.5)
_TRIED = 0.4
"""Shade of a table where the robot has tried to pick."""


def draw(robot: PlainRobot) -> tuple[Mark, ...]:
    """The world as it is now."""
    return (*_tables(robot), *_cubes(robot), *_belief(robot), _robot(robot), _posture(robot))


def _tables(robot: PlainRobot) -> Iterator[Mark]:
    for number, (x, y, _) in enumerate(CUBES):
        shade = _TRIED if f"pick{number}" in robot.visited else 1.0
        yield Mark(f"table {number}", "square", "place", x, y, 0.9, shade, f"table {number}")
    yield Mark("place table", "square", "place", GOAL[0], GOAL[1], 0.9, 1.0, "place table")
    yield Mark("goal", "circle", "goal", GOAL[0], GOAL[1], 0.5)


def _cubes(robot: PlainRobot) -> Iterator[Mark]:
    for number, (x, y, _) in enumerate(robot.cubes):
        yield Mark(f"cube {number}", "square", "object", round(x, 2), round(y, 2), 0.3)


def _belief(robot: PlainRobot) -> Iterator[Mark]:
    """Where the robot believes to be, and how far that is from where it is."""
    (x, y), (to_x, to_y) = (tuple(round(number, 2) for number in place) for place in (robot.pose, robot.estimate))
    yield Mark("error", "line", "belief", x, y, 0.05, 0.5, f"{robot.error:.1f} m", to_x, to_y)
    yield Mark("estimate", "circle", "belief", to_x, to_y, 0.5, 0.5)


def _robot(robot: PlainRobot) -> Mark:
    (x, y), (right, up) = robot.pose, FACING[robot.place]
    angle = round(math.atan2(up, right), 2)
    label = "" if robot.localised else "lost"
    return Mark("robot", "triangle", "robot", round(x, 2), round(y, 2), 0.8, 1.0, label, angle=angle)


def _posture(robot: PlainRobot) -> Mark:
    held = "" if robot.held is None else f", holding cube {robot.held}"
    return Mark("posture", "text", "note", 0.5, -12.5, 0.5, label=f"head {robot.head}, arm {robot.arm}{held}")
