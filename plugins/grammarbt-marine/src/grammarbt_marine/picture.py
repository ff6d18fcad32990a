"""The picture of a marine episode: a roadmap with what lies there, what the robots believe, and where they are."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from grammarbt.domain import Mark
from grammarbt_marine.layouts import DROP_OFF, START
from grammarbt_marine.state import MINE, OBJECT, TARGET

if TYPE_CHECKING:
    from grammarbt.domain import Role, Shape
    from grammarbt_marine.parameters import MarineParameters
    from grammarbt_marine.plain import PlainEpisode
    from grammarbt_marine.plain_robot import PlainRobot

BOX = (-0.05, -0.05, 1.05, 1.05)

_SHADES = 8
"""A belief is drawn in so many shades, so that few marks change in a step."""
_LOOKS: dict[int, tuple[Role, Shape]] = {
    TARGET: ("goal", "circle"),
    MINE: ("hazard", "triangle"),
    OBJECT: ("object", "square"),
}
_DEPTH_OFFSET = 0.012
"""Vertices below others are drawn this far to the lower right."""
_LEAST_LOG_ODDS = -700.0
"""Below these, a probability is zero, and its exponential too large."""
_DONE = 0.25
"""Shade of what is dealt with."""


class Picture:
    """Draws an episode; marks of one name replace each other as it goes on."""

    def __init__(self, parameters: MarineParameters, sea: PlainEpisode) -> None:
        self._sea, self._parameters = sea, parameters
        self._places = [_place(position) for position in sea.roadmap.position]
        self._things = dict(sea.content)
        self._seen_at = [START] * len(sea.robots)
        self._heading = [0.0] * len(sea.robots)

    def ground(self) -> tuple[Mark, ...]:
        """What never changes: the comms region, edges, vertices, start and drop-off."""
        return (*self._region(), *self._edges(), *self._vertices())

    def now(self) -> tuple[Mark, ...]:
        """What may have changed: things, beliefs and robots."""
        robots = tuple(self._robot(robot) for robot in self._sea.robots)
        return (*self._beliefs(), *self._all_things(), *robots)

    def _region(self) -> Iterator[Mark]:
        x, y = self._places[START]
        yield Mark("comms", "circle", "ground", x, y, 2 * self._parameters.comms_range, 0.5, "comms")

    def _edges(self) -> Iterator[Mark]:
        """One line between two points, however many edges lie behind each other there."""
        drawn: dict[tuple[int, ...], Mark] = {}
        roadmap = self._sea.roadmap
        lowest = [self._lowest_here(vertex) for vertex in range(len(self._places))]
        for vertex, row in enumerate(roadmap.neighbours):
            for other in row[: roadmap.degree[vertex]]:
                ends = tuple(sorted((lowest[vertex], lowest[other])))
                (x, y), (to_x, to_y) = (self._places[end] for end in ends)
                drawn[ends] = Mark(f"edge {ends[0]} {ends[1]}", "line", "path", x, y, 0.002, 0.5, to_x=to_x, to_y=to_y)
        yield from (mark for ends, mark in drawn.items() if ends[0] != ends[1])

    def _lowest_here(self, vertex: int) -> int:
        """The vertex itself, or the one at the surface above it."""
        return vertex % (len(self._places) // 2) if self._parameters.layout == "depths" else vertex

    def _vertices(self) -> Iterator[Mark]:
        labels = {START: "start", DROP_OFF: "drop-off"}
        for vertex, (x, y) in enumerate(self._places):
            shade = 1.0 if self._sea.roadmap.surface[vertex] else 0.5
            yield Mark(f"vertex {vertex}", "circle", "place", x, y, 0.01, shade, labels.get(vertex, ""))

    def _beliefs(self) -> Iterator[Mark]:
        """At each vertex the class that the robots are surest of, and how sure."""
        for vertex, (x, y) in enumerate(self._places):
            beliefs = {kind: self._belief(kind, vertex) for kind in _LOOKS}
            kind = max(beliefs, key=beliefs.__getitem__)
            shade = round(beliefs[kind] * _SHADES) / _SHADES
            yield Mark(f"belief {vertex}", "circle", _LOOKS[kind][0] if shade else "belief", x, y, 0.04, shade)

    def _belief(self, kind: int, vertex: int) -> float:
        belief: float = max(robot.belief[kind][vertex] for robot in self._sea.robots)
        if self._sea.rules.classifies:
            return belief
        return 1.0 / (1.0 + math.exp(-belief)) if belief > _LEAST_LOG_ODDS else 0.0

    def _all_things(self) -> Iterator[Mark]:
        for vertex, kind in self._things.items():
            (x, y), (role, shape) = self._places[vertex], _LOOKS[kind]
            name = f"{('target', 'mine', 'object')[kind]} {vertex}"
            yield Mark(name, shape, role, x, y, 0.02, self._left(vertex, kind), angle=math.pi / 2)

    def _left(self, vertex: int, kind: int) -> float:
        """The shade of a thing: gone, dealt with, or still to do."""
        sea = self._sea
        if kind == OBJECT:
            return 1.0 if vertex in sea.content else 0.0
        return _DONE if vertex in (sea.reported if kind == TARGET else sea.disarmed) else 1.0

    def _robot(self, robot: PlainRobot) -> Mark:
        number, (x, y) = robot.number, self._places[robot.vertex]
        before_x, before_y = self._places[self._seen_at[number]]
        if robot.vertex != self._seen_at[number]:
            self._heading[number] = round(math.atan2(y - before_y, x - before_x), 2)
            self._seen_at[number] = robot.vertex
        state = "lost" if robot.dead else "carrying" if robot.carrying else ""
        label = state if len(self._sea.robots) == 1 else f"{number + 1} {state}".strip()
        return Mark(f"robot {number + 1}", "triangle", "robot", x, y, 0.04, 1.0, label, angle=self._heading[number])


def _place(position: list[float]) -> tuple[float, float]:
    down = _DEPTH_OFFSET if position[2:] > [0.0] else 0.0
    return round(position[0] + down, 3), round(position[1] - down, 3)
