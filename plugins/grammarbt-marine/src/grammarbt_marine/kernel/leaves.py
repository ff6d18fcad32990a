"""Leaves: which function does what an action does, or answers a condition, by its place in `LEAVES`."""

from __future__ import annotations

from grammarbt_marine.kernel.acting import disarm, pick_up, report, take_to_drop_off
from grammarbt_marine.kernel.codes import MINE, NOTHING, OBJECT
from grammarbt_marine.kernel.moving import (
    go,
    go_up,
    nearest_likely_target,
    nearest_unvisited,
    next_of_sweep,
    walk_at_random,
)
from grammarbt_marine.kernel.sensing import any_target_found, found
from grammarbt_marine.program import FAILURE, SUCCESS, compiled
from grammarbt_marine.state import World

GO_TO_COMMS, RESURFACE, REPORT, DISARM, PICK_UP, TAKE_TO_DROP_OFF = range(6)
GO_TO_LIKELY_TARGET, RANDOM_WALK, SHORTEST_PATH = range(6, 9)
IN_COMMS, TARGET_FOUND, AT_SURFACE, MINE_FOUND, IS_ARMED = range(10, 15)
OBJECT_FOUND, CARRYING_OBJECT, LIKELY_TARGET_FOUND = range(15, 18)


@compiled
def visit(world: World, leaf: int) -> int:
    """Do at most one step of an action, or ask a condition; gives the status."""
    if leaf < IN_COMMS:
        return _act(world, leaf)
    return SUCCESS if _holds(world, leaf) else FAILURE


@compiled
def takes_step(leaf: int, status: int) -> bool:
    """Whether the leaf that answered so has taken a step."""
    return leaf < IN_COMMS and (leaf > RESURFACE or status != SUCCESS)


@compiled
def _act(world: World, action: int) -> int:
    here = world.robot.vertex
    if action == GO_TO_COMMS:
        status = go_up(world, world.roadmap.nearest_comms[here])
    elif action == RESURFACE:
        status = go_up(world, world.roadmap.nearest_surface[here])
    elif action == REPORT:
        status = report(world)
    elif action == DISARM:
        status = disarm(world)
    elif action == PICK_UP:
        status = pick_up(world)
    elif action == TAKE_TO_DROP_OFF:
        status = take_to_drop_off(world)
    elif action == GO_TO_LIKELY_TARGET:
        status = go(world, nearest_likely_target(world))
    elif action == RANDOM_WALK:
        status = walk_at_random(world)
    elif action == SHORTEST_PATH:
        status = go(world, nearest_unvisited(world))
    else:
        status = go(world, next_of_sweep(world))
    return status


@compiled
def _holds(world: World, condition: int) -> bool:
    robot = world.robot
    if condition == IN_COMMS:
        answer = bool(world.roadmap.comms[robot.vertex])
    elif condition == TARGET_FOUND:
        answer = any_target_found(world)
    elif condition == AT_SURFACE:
        answer = bool(world.roadmap.surface[robot.vertex])
    elif condition == MINE_FOUND:
        answer = found(world, MINE, robot.vertex)
    elif condition == IS_ARMED:
        answer = not world.sea.disarmed[robot.vertex]
    elif condition == OBJECT_FOUND:
        answer = bool(robot.carrying) or found(world, OBJECT, robot.vertex)
    elif condition == CARRYING_OBJECT:
        answer = bool(robot.carrying)
    elif condition == LIKELY_TARGET_FOUND:
        answer = nearest_likely_target(world) != NOTHING
    else:
        answer = bool(robot.travelled >= world.rules.battery_low)
    return answer
