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
from grammarbt_toys.foraging_seeing import FOOD, HUB, distance, look, near, where
from grammarbt_toys.foraging_world import UNKNOWN, Robot, World, add_food, begin, direction, take_food
from grammarbt_toys.program import FAILURE, RUNNING, SUCCESS, Program, cached, inlined

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
REACH = 1
"""A robot drops and picks up as many cells away."""
TURNING = 0.1
"""The probability that an exploring robot changes its direction."""


@cached
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
        begin(world, pieces, scenarios[index])
        delivered = 0
        for step in range(1, steps + 1):
            for robot in range(len(world.robots)):
                delivered += _tick(program, world, robot, scenarios[index], step)
        returns[index] = delivered
    return returns


@inlined
def _tick(program: Program, world: World, number: int, scenario: int, step: int) -> int:
    """Tick one robot; gives the pieces that it brought to the hub."""
    robot = world.robots[number]
    robot.moved = False
    look(world, robot)
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
            delivered += robot.carrying != 0 and near(world, robot, HUB, REACH)
            status = _drop(world, robot)
        at = program.follow[at, status]
        if at >= 0:
            look(world, robot)
    return delivered


@inlined
def _holds(world: World, robot: Robot, condition: int) -> bool:
    if condition >= VISITED_BEFORE:
        return where(world, robot, condition - VISITED_BEFORE)[0] != UNKNOWN
    if condition >= DROPPABLE:
        return robot.carrying != 0 and near(world, robot, condition - DROPPABLE, REACH)
    if condition == CARRYING:
        return bool(robot.carrying != 0)
    return near(world, robot, condition - NEIGHBOUR, world.sight)


@inlined
def _pick_up(world: World, robot: Robot) -> int:
    row, column = where(world, robot, FOOD)
    if robot.carrying != 0 or row == UNKNOWN or distance(robot, row, column) > REACH:
        return FAILURE
    take_food(world, row, column)
    robot.carrying = True
    return SUCCESS


@inlined
def _drop(world: World, robot: Robot) -> int:
    """What is dropped at the hub is stored there; elsewhere it lies on the ground."""
    if robot.carrying == 0:
        return FAILURE
    robot.carrying = False
    if not near(world, robot, HUB, REACH):
        add_food(world, robot.row, robot.column, 1)
    return SUCCESS


@inlined
def _explore(world: World, robot: Robot, number: int, scenario: int, step: int) -> int:
    """Go straight on, now and then along a new direction; a wall turns the robot back."""
    if robot.moved != 0:
        return RUNNING
    if uniform(scenario, step, 2 * number) < TURNING:
        robot.down, robot.right = direction(uniform(scenario, step, 2 * number + 1))
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
    row, column = where(world, robot, action - (MOVE_AWAY if away else MOVE_TOWARDS))
    if row == UNKNOWN or (not away and distance(robot, row, column) == 0):
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
