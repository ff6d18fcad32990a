"""Sensing: what a robot sees of the vertices in range, what it hears in comms, and what it then believes."""

from __future__ import annotations

from grammarbt_marine.kernel.chance import uniform
from grammarbt_marine.kernel.codes import SENSING, TARGET
from grammarbt_marine.program import compiled
from grammarbt_marine.state import World

LEAST_BELIEF = 1e-12
"""A classifying robot is never surer than this that a class is not there, so that it can change its mind."""


@compiled
def sense(world: World) -> None:
    """Unless it is under way or lost, look at every vertex in range and update the belief by Bayes' rule."""
    robot = world.robot
    if robot.under_way > 0 or robot.travelled >= world.rules.battery_dead:
        return
    if world.rules.classifies:
        _classify(world)
    else:
        _detect(world)


@compiled
def _detect(world: World) -> None:
    """Look for each class on its own."""
    robot, roadmap = world.robot, world.roadmap
    here = robot.vertex
    for place in range(roadmap.reach[here]):
        vertex = roadmap.in_range[here, place]
        for kind in range(3):
            present = world.sea.content[vertex] == kind
            chance = roadmap.detection[here, place, kind] if present else world.rules.false_alarm[kind]
            detected = uniform(world, SENSING, vertex * 3 + kind) < chance
            robot.belief[kind, vertex] += (
                roadmap.gain[here, place, kind] if detected else roadmap.loss[here, place, kind]
            )


@compiled
def _classify(world: World) -> None:
    """Read one of the four classes; the last is nothing."""
    robot, roadmap, rules = world.robot, world.roadmap, world.rules
    for place in range(roadmap.reach[robot.vertex]):
        vertex = roadmap.in_range[robot.vertex, place]
        reading = _reading(world, vertex)
        total = 0.0
        for kind in range(4):
            robot.belief[kind, vertex] *= rules.right if kind == reading else rules.wrong
            total += robot.belief[kind, vertex]
        for kind in range(4):
            robot.belief[kind, vertex] = max(robot.belief[kind, vertex] / total, LEAST_BELIEF)


@compiled
def _reading(world: World, vertex: int) -> int:
    """The class that is there, or by mistake any other."""
    beyond = uniform(world, SENSING, vertex * 3) - world.rules.right
    mistaken = 0 if beyond < 0.0 else 1 + int(beyond / world.rules.wrong) % 3
    return int(world.sea.content[vertex] + mistaken) % 4


@compiled
def hear(world: World) -> None:
    """Learn in comms what the others reported."""
    robot, sea = world.robot, world.sea
    if world.roadmap.comms[robot.vertex]:
        for vertex in range(sea.reported.size):
            robot.told[vertex] |= sea.reported[vertex]


@compiled
def found(world: World, kind: int, vertex: int) -> bool:
    """Whether the robot believes that a thing of the class is there."""
    return bool(world.robot.belief[kind, vertex] > world.rules.found[kind])


@compiled
def target_found(world: World, vertex: int) -> bool:
    """Whether the robot believes that a target is there of which it knows no report."""
    return found(world, TARGET, vertex) and not world.robot.told[vertex]


@compiled
def any_target_found(world: World) -> bool:
    """Whether that is so anywhere."""
    vertices, vertex = world.robot.told.size, 0
    while vertex < vertices and not target_found(world, vertex):
        vertex += 1
    return bool(vertex < vertices)


@compiled
def target_likely(world: World, vertex: int) -> bool:
    """Whether it suspects one there."""
    robot, rules = world.robot, world.rules
    return rules.likely < robot.belief[TARGET, vertex] <= rules.found[TARGET] and not robot.told[vertex]
