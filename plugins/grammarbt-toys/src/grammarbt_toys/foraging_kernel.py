"""A swarm forages, compiled.

The rules of time. In every step each robot in turn is ticked once, all with the same tree. A robot moves at most one
cell per tick, in eight directions; moves are running, also a second one, which waits. Picking up and dropping take no
time. A robot looks before its tick, and again when the tick goes on after an action.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grammarbt.domain import Scenarios
from grammarbt_toys.chance import uniform
from grammarbt_toys.program import FAILURE, RUNNING, SUCCESS, Program, compiled

LEAVES = (
    *("pick up", "drop", "explore"),
    *("move towards(thing=hub)", "move towards(thing=site)", "move towards(thing=food)"),
    *("move away(thing=hub)", "move away(thing=site)", "move away(thing=food)"),
    *("neighbour(thing=hub)", "neighbour(thing=site)", "neighbour(thing=food)"),
    *("carrying(thing=food)", "droppable(thing=hub)", "droppable(thing=site)"),
    *("visited before(thing=hub)", "visited before(thing=site)"),
)
"""What the kernel knows; a leaf's place here is its number in the vocabulary."""

PICK_UP, DROP, EXPLORE, MOVE_TOWARDS, MOVE_AWAY, NEIGHBOUR = 0, 1, 2, 3, 6, 9
CARRYING, DROPPABLE, VISITED_BEFORE = 12, 13, 15
HUB, SITE, FOOD = range(3)
UNKNOWN = -1
REACH = 1
"""A robot drops and picks up as many cells away."""
TURNING = 0.1
"""The probability that an exploring robot changes its direction."""
STAYING = 4
"""The number of the middle of nine directions, which leads nowhere."""
PLACING = 2**20
"""Decisions with this number and above place things; below, they are the robots'."""


class World(NamedTuple):
    """R robots on a square of N cells a side.

    Attributes:
        food: (N, N) pieces that lie in each cell.
        sites: (S, 2) cells at which food lay at the start.
        robots: (R, 2) where the robots are.
        heading: (R, 2) the step that each robot explores along.
        carrying: (R,) whether it carries a piece of food.
        known: (R, 3, 2) where it last saw hub, site and food; -1 where it does not know.
        sight: cells that a robot sees to each side.
    """

    food: NDArray[np.int64]
    sites: NDArray[np.int64]
    robots: NDArray[np.int64]
    heading: NDArray[np.int64]
    carrying: NDArray[np.bool_]
    known: NDArray[np.int64]
    sight: int


@compiled
def simulate(program: Program, world: World, pieces: int, steps: int, scenarios: Scenarios) -> NDArray[np.float64]:
    """Run an episode per scenario; gives the pieces of food brought to the hub.

    Args:
        program: what each robot does, over leaves as in `LEAVES`.
        world: overwritten.
        pieces: how many pieces of food each site has.
        steps: how many steps an episode has.
        scenarios: (n,) what fixes all chance.
    """
    returns = np.empty(scenarios.size)
    for index in range(scenarios.size):
        _begin(world, pieces, scenarios[index])
        delivered = 0
        for step in range(1, steps + 1):
            for robot in range(len(world.robots)):
                delivered += _tick(program, world, robot, scenarios[index], step)
        returns[index] = delivered
    return returns


@compiled
def _begin(world: World, pieces: int, scenario: int) -> None:
    """Put the robots anywhere and the sites anywhere far from the hub, which is in the middle."""
    size = len(world.food)
    world.food[:] = 0
    world.carrying[:] = False
    world.known[:] = UNKNOWN
    item = PLACING
    for robot in range(len(world.robots)):
        item = _place(world.robots[robot], size, 0, scenario, item)
        world.heading[robot] = _direction(uniform(scenario, 0, robot))
    for site in range(len(world.sites)):
        item = _place(world.sites[site], size, size // 4, scenario, item)
        world.food[world.sites[site, 0], world.sites[site, 1]] += pieces


@compiled
def _place(cell: NDArray[np.int64], size: int, least: int, scenario: int, item: int) -> int:
    """Draw a cell that is so far from the hub; gives the number of the next decision."""
    while True:
        cell[0] = int(uniform(scenario, 0, item) * size)
        cell[1] = int(uniform(scenario, 0, item + 1) * size)
        item += 2
        if _distance(cell, size // 2, size // 2) >= least:
            return item


@compiled
def _direction(chance: float) -> tuple[int, int]:
    """One of the eight directions, row by row."""
    number = int(chance * 8)
    number += number >= STAYING
    return number // 3 - 1, number % 3 - 1


@compiled
def _distance(cell: NDArray[np.int64], row: int, column: int) -> int:
    """In moves; a diagonal one counts once."""
    return int(max(abs(cell[0] - row), abs(cell[1] - column)))


@compiled
def _tick(program: Program, world: World, robot: int, scenario: int, step: int) -> int:
    """Tick one robot; gives the pieces that it brought to the hub."""
    _look(world, robot)
    at, delivered, moved = 0, 0, False
    while at >= 0:
        leaf = program.leaf[at]
        program.ticks[program.occurrence[at]] += 1
        if leaf >= NEIGHBOUR:
            status = SUCCESS if _holds(world, robot, leaf) else FAILURE
        elif leaf == PICK_UP:
            status = _pick_up(world, robot)
        elif leaf == DROP:
            delivered += _delivers(world, robot)
            status = _drop(world, robot)
        elif leaf == EXPLORE:
            status = RUNNING if moved else _explore(world, robot, scenario, step)
        else:
            status = _go(world, robot, leaf, moved)
        moved = moved or status == RUNNING
        at = program.follow[at, status]
        if leaf < NEIGHBOUR and at >= 0:
            _look(world, robot)
    return delivered


@compiled
def _look(world: World, robot: int) -> None:
    """Remember the hub and a site that are in sight; forget a site in sight that is empty, and food out of sight."""
    place, known, middle = world.robots[robot], world.known[robot], len(world.food) // 2
    if _distance(place, middle, middle) <= world.sight:
        known[HUB] = middle
    for site in range(len(world.sites)):
        row, column = world.sites[site]
        if _distance(place, row, column) <= world.sight:
            if world.food[row, column] > 0:
                known[SITE, 0], known[SITE, 1] = row, column
            elif _distance(known[SITE], row, column) == 0:
                known[SITE] = UNKNOWN
    _look_for_food(world, robot)


@compiled
def _look_for_food(world: World, robot: int) -> None:
    """The nearest food in sight that does not lie at the hub; among equals the first, row by row."""
    place, food, sight, size = world.robots[robot], world.food, world.sight, len(world.food)
    north, west = max(0, place[0] - sight), max(0, place[1] - sight)
    south, east = min(size, place[0] + sight + 1), min(size, place[1] + sight + 1)
    nearest, at_row, at_column = sight + 1, UNKNOWN, UNKNOWN
    for row in range(north, south):
        for column in range(west, east):
            if food[row, column] > 0 and _distance(place, row, column) < nearest:
                nearest, at_row, at_column = _distance(place, row, column), row, column
    world.known[robot, FOOD, 0], world.known[robot, FOOD, 1] = at_row, at_column


@compiled
def _holds(world: World, robot: int, condition: int) -> bool:
    if condition >= VISITED_BEFORE:
        return bool(world.known[robot, condition - VISITED_BEFORE, 0] != UNKNOWN)
    if condition >= DROPPABLE:
        return bool(world.carrying[robot]) and _near(world, robot, condition - DROPPABLE, REACH)
    if condition == CARRYING:
        return bool(world.carrying[robot])
    return _near(world, robot, condition - NEIGHBOUR, world.sight)


@compiled
def _near(world: World, robot: int, thing: int, cells: int) -> bool:
    """Whether a thing of that kind, known or not, is at most so many cells away."""
    place, middle = world.robots[robot], len(world.food) // 2
    if thing == HUB:
        return _distance(place, middle, middle) <= cells
    if thing == FOOD:
        row, column = world.known[robot, FOOD]
        return row != UNKNOWN and _distance(place, row, column) <= cells
    for site in range(len(world.sites)):
        if _distance(place, world.sites[site, 0], world.sites[site, 1]) <= cells:
            return True
    return False


@compiled
def _pick_up(world: World, robot: int) -> int:
    if world.carrying[robot] or not _near(world, robot, FOOD, REACH):
        return FAILURE
    row, column = world.known[robot, FOOD]
    world.food[row, column] -= 1
    world.carrying[robot] = True
    return SUCCESS


@compiled
def _delivers(world: World, robot: int) -> bool:
    return bool(world.carrying[robot]) and _near(world, robot, HUB, REACH)


@compiled
def _drop(world: World, robot: int) -> int:
    """What is dropped at the hub is stored there; elsewhere it lies on the ground."""
    if not world.carrying[robot]:
        return FAILURE
    if not _delivers(world, robot):
        world.food[world.robots[robot, 0], world.robots[robot, 1]] += 1
    world.carrying[robot] = False
    return SUCCESS


@compiled
def _explore(world: World, robot: int, scenario: int, step: int) -> int:
    """Go straight on, now and then along a new direction; a wall turns the robot back."""
    if uniform(scenario, step, 2 * robot) < TURNING:
        world.heading[robot] = _direction(uniform(scenario, step, 2 * robot + 1))
    for axis in range(2):
        if not 0 <= world.robots[robot, axis] + world.heading[robot, axis] < len(world.food):
            world.heading[robot, axis] *= -1
        world.robots[robot, axis] += world.heading[robot, axis]
    return RUNNING


@compiled
def _go(world: World, robot: int, action: int, moved: bool) -> int:
    """One cell towards a thing or away from it; fails when the robot does not know where one is, or is there."""
    away = action >= MOVE_AWAY
    goal = world.known[robot, action - (MOVE_AWAY if away else MOVE_TOWARDS)]
    there = not away and _distance(world.robots[robot], goal[0], goal[1]) == 0
    if goal[0] == UNKNOWN or there:
        return FAILURE
    if not moved:
        for axis in range(2):
            step = np.sign(goal[axis] - world.robots[robot, axis]) * (-1 if away else 1)
            world.robots[robot, axis] = min(max(world.robots[robot, axis] + step, 0), len(world.food) - 1)
    return RUNNING
