"""A swarm forages, compiled.

The rules of time. In every step each robot in turn is ticked once, all with the same tree. A robot moves at most one
cell per tick, in eight directions; moves are running, also a second one, which waits. Picking up and dropping take no
time. A robot looks before its tick, and again when the tick goes on after an action.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grammarbt.domain import Scenarios
from grammarbt_toys.chance import uniform
from grammarbt_toys.foraging_world import UNKNOWN, Robot, World
from grammarbt_toys.program import FAILURE, RUNNING, SUCCESS, Program, compiled, inlined

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
REACH = 1
"""A robot drops and picks up as many cells away."""
TURNING = 0.1
"""The probability that an exploring robot changes its direction."""
STAYING = 4
"""The number of the middle of nine directions, which leads nowhere."""
PLACING = 2**20
"""Decisions with this number and above place things; below, they are the robots'."""


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


@inlined
def _begin(world: World, pieces: int, scenario: int) -> None:
    """Put the robots anywhere and the sites anywhere far from the hub."""
    size, item = len(world.food), PLACING
    world.food[:] = 0
    world.filled[0] = 0
    for number in range(len(world.robots)):
        robot = world.robots[number]
        robot.row, robot.column, item = _free_cell(size, 0, scenario, item)
        robot.down, robot.right = _direction(uniform(scenario, 0, number))
        robot.carrying = robot.knows_hub = False
        robot.site_row = robot.site_column = UNKNOWN
    for site in range(len(world.sites)):
        row, column, item = _free_cell(size, size // 4, scenario, item)
        world.sites[site] = row, column
        _add_food(world, row, column, pieces)


@inlined
def _free_cell(size: int, least: int, scenario: int, item: int) -> tuple[int, int, int]:
    """Draw a cell that is so far from the hub; gives it and the number of the next decision."""
    while True:
        row, column = int(uniform(scenario, 0, item) * size), int(uniform(scenario, 0, item + 1) * size)
        item += 2
        if max(abs(row - size // 2), abs(column - size // 2)) >= least:
            return row, column, item


@inlined
def _direction(chance: float) -> tuple[int, int]:
    """One of the eight directions, row by row."""
    number = int(chance * 8)
    number += number >= STAYING
    return number // 3 - 1, number % 3 - 1


@inlined
def _add_food(world: World, row: int, column: int, pieces: int) -> None:
    if world.food[row, column] == 0:
        world.piles[world.filled[0]] = row, column
        world.filled[0] += 1
    world.food[row, column] += pieces


@inlined
def _take_food(world: World, row: int, column: int) -> None:
    world.food[row, column] -= 1
    if world.food[row, column] == 0:
        pile = 0
        while world.piles[pile, 0] != row or world.piles[pile, 1] != column:
            pile += 1
        world.filled[0] -= 1
        world.piles[pile] = world.piles[world.filled[0]]


@inlined
def _tick(program: Program, world: World, number: int, scenario: int, step: int) -> int:
    """Tick one robot; gives the pieces that it brought to the hub."""
    robot = world.robots[number]
    robot.moved = False
    _look(world, robot)
    at, delivered = 0, 0
    while at >= 0:
        leaf = program.leaf[at]
        program.ticks[program.occurrence[at]] += 1
        if leaf >= NEIGHBOUR:
            at = program.follow[at, SUCCESS if _holds(world, robot, leaf) else FAILURE]
            continue
        if leaf == EXPLORE:
            status = _explore(world, robot, number, scenario, step)
        elif leaf >= MOVE_TOWARDS:
            status = _go(world, robot, leaf)
        elif leaf == PICK_UP:
            status = _pick_up(world, robot)
        else:
            delivered += robot.carrying != 0 and _near(world, robot, HUB, REACH)
            status = _drop(world, robot)
        at = program.follow[at, status]
        if at >= 0:
            _look(world, robot)
    return delivered


@inlined
def _look(world: World, robot: Robot) -> None:
    """Remember the hub and a site that are in sight; forget a site in sight that is empty."""
    robot.knows_hub = robot.knows_hub != 0 or _near(world, robot, HUB, world.sight)
    for site in range(len(world.sites)):
        row, column = world.sites[site, 0], world.sites[site, 1]
        if _distance(robot, row, column) <= world.sight:
            if world.food[row, column] > 0:
                robot.site_row, robot.site_column = row, column
            elif robot.site_row == row and robot.site_column == column:
                robot.site_row = robot.site_column = UNKNOWN


@inlined
def _distance(robot: Robot, row: int, column: int) -> int:
    """In moves; a diagonal one counts once."""
    return int(max(abs(robot.row - row), abs(robot.column - column)))


@inlined
def _where(world: World, robot: Robot, thing: int) -> tuple[int, int]:
    """Where the robot knows the hub, a site, or food: the nearest in sight; among equals the first, row by row."""
    if thing == HUB:
        middle = len(world.food) // 2
        return (middle, middle) if robot.knows_hub != 0 else (UNKNOWN, UNKNOWN)
    if thing == SITE:
        return robot.site_row, robot.site_column
    nearest, at_row, at_column = world.sight + 1, UNKNOWN, UNKNOWN
    for pile in range(world.filled[0]):
        row, column = world.piles[pile, 0], world.piles[pile, 1]
        distance = _distance(robot, row, column)
        if distance < nearest or (distance == nearest and (row, column) < (at_row, at_column)):
            nearest, at_row, at_column = distance, row, column
    return at_row, at_column


@inlined
def _holds(world: World, robot: Robot, condition: int) -> bool:
    if condition >= VISITED_BEFORE:
        return _where(world, robot, condition - VISITED_BEFORE)[0] != UNKNOWN
    if condition >= DROPPABLE:
        return robot.carrying != 0 and _near(world, robot, condition - DROPPABLE, REACH)
    if condition == CARRYING:
        return bool(robot.carrying != 0)
    return _near(world, robot, condition - NEIGHBOUR, world.sight)


@inlined
def _near(world: World, robot: Robot, thing: int, cells: int) -> bool:
    """Whether a thing of that kind, known or not, is at most so many cells away."""
    if thing == HUB:
        return _distance(robot, len(world.food) // 2, len(world.food) // 2) <= cells
    if thing == FOOD:
        row, column = _where(world, robot, FOOD)
        return row != UNKNOWN and _distance(robot, row, column) <= cells
    near = False
    for site in range(len(world.sites)):
        near = near or _distance(robot, world.sites[site, 0], world.sites[site, 1]) <= cells
    return near


@inlined
def _pick_up(world: World, robot: Robot) -> int:
    row, column = _where(world, robot, FOOD)
    if robot.carrying != 0 or row == UNKNOWN or _distance(robot, row, column) > REACH:
        return FAILURE
    _take_food(world, row, column)
    robot.carrying = True
    return SUCCESS


@inlined
def _drop(world: World, robot: Robot) -> int:
    """What is dropped at the hub is stored there; elsewhere it lies on the ground."""
    if robot.carrying == 0:
        return FAILURE
    robot.carrying = False
    if not _near(world, robot, HUB, REACH):
        _add_food(world, robot.row, robot.column, 1)
    return SUCCESS


@inlined
def _explore(world: World, robot: Robot, number: int, scenario: int, step: int) -> int:
    """Go straight on, now and then along a new direction; a wall turns the robot back."""
    if robot.moved != 0:
        return RUNNING
    if uniform(scenario, step, 2 * number) < TURNING:
        robot.down, robot.right = _direction(uniform(scenario, step, 2 * number + 1))
    size = len(world.food)
    if not 0 <= robot.row + robot.down < size:
        robot.down = -robot.down
    if not 0 <= robot.column + robot.right < size:
        robot.right = -robot.right
    _move(world, robot, robot.down, robot.right)
    return RUNNING


@inlined
def _go(world: World, robot: Robot, action: int) -> int:
    """One cell towards a thing or away from it; fails when the robot does not know where one is, or is there."""
    away = action >= MOVE_AWAY
    row, column = _where(world, robot, action - (MOVE_AWAY if away else MOVE_TOWARDS))
    if row == UNKNOWN or (not away and _distance(robot, row, column) == 0):
        return FAILURE
    sign = -1 if away else 1
    _move(world, robot, sign * np.sign(row - robot.row), sign * np.sign(column - robot.column))
    return RUNNING


@inlined
def _move(world: World, robot: Robot, down: int, right: int) -> None:
    """Move one cell, or stay at a wall; only once a tick."""
    if robot.moved == 0:
        robot.row = min(max(robot.row + down, 0), len(world.food) - 1)
        robot.column = min(max(robot.column + right, 0), len(world.food) - 1)
        robot.moved = True
