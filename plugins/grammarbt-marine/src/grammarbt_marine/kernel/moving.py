"""Moving: along one edge of the roadmap at a time, and where to."""

from __future__ import annotations

import numpy as np

from grammarbt_marine.kernel.chance import uniform
from grammarbt_marine.kernel.codes import NOTHING, START, WALKING
from grammarbt_marine.kernel.sensing import target_likely
from grammarbt_marine.program import FAILURE, RUNNING, SUCCESS, compiled
from grammarbt_marine.state import World


@compiled
def go_up(world: World, goal: int) -> int:
    """`go`, but there is nothing to do where the robot is already there."""
    return SUCCESS if goal == world.robot.vertex else go(world, goal)


@compiled
def go(world: World, goal: int) -> int:
    """Set out along one edge towards the goal, or stay there; fails without a goal."""
    if goal == NOTHING:
        return FAILURE
    _move(world, world.roadmap.next_hop[world.robot.vertex, goal])
    return RUNNING


@compiled
def walk_at_random(world: World) -> int:
    """Set out along any edge."""
    robot = world.robot
    edge = int(uniform(world, WALKING, START) * world.roadmap.degree[robot.vertex])
    _move(world, world.roadmap.neighbours[robot.vertex, edge])
    return RUNNING


@compiled
def _move(world: World, vertex: int) -> None:
    robot = world.robot
    if vertex == robot.vertex:
        return
    if world.rules.costs_matter:
        _pay(world, vertex)
    robot.work = 0
    robot.vertex = vertex
    robot.visited[vertex] = True


@compiled
def _pay(world: World, vertex: int) -> None:
    """The time and the charge that the edge takes."""
    robot, rules = world.robot, world.rules
    cost = world.roadmap.distance[robot.vertex, vertex]
    robot.under_way = int(np.ceil(cost / rules.speed)) - 1
    robot.travelled += cost
    if world.roadmap.surface[vertex] and robot.travelled < rules.battery_dead:
        robot.travelled = 0.0


@compiled
def nearest_likely_target(world: World) -> int:
    """A vertex, or NOTHING."""
    distance = world.roadmap.distance[world.robot.vertex]
    nearest = NOTHING
    for vertex in range(distance.size):
        if target_likely(world, vertex) and (nearest == NOTHING or distance[vertex] < distance[nearest]):
            nearest = vertex
    return nearest


@compiled
def nearest_unvisited(world: World) -> int:
    """A vertex, or NOTHING."""
    distance = world.roadmap.distance[world.robot.vertex]
    nearest = NOTHING
    for vertex in range(distance.size):
        if not world.robot.visited[vertex] and (nearest == NOTHING or distance[vertex] < distance[nearest]):
            nearest = vertex
    return nearest


@compiled
def next_of_sweep(world: World) -> int:
    """A vertex, or NOTHING."""
    for vertex in world.roadmap.sweep:
        if not world.robot.visited[vertex]:
            return int(vertex)
    return NOTHING
