"""Acting: what a robot does to the sea where it is, for reward."""

from __future__ import annotations

from grammarbt_marine.kernel.codes import DROP_OFF, MINE, NOTHING, OBJECT, TARGET
from grammarbt_marine.kernel.moving import go
from grammarbt_marine.kernel.sensing import target_found
from grammarbt_marine.program import FAILURE, RUNNING, SUCCESS, compiled
from grammarbt_marine.state import World


@compiled
def report(world: World) -> int:
    """Report every vertex where a target was found; only the right ones are rewarded."""
    robot, sea = world.robot, world.sea
    if not world.roadmap.comms[robot.vertex]:
        return FAILURE
    for vertex in range(sea.content.size):
        if target_found(world, vertex):
            if sea.content[vertex] == TARGET and not sea.reported[vertex]:
                sea.reward += world.rules.reward[TARGET]
            robot.told[vertex] = sea.reported[vertex] = True
    return SUCCESS


@compiled
def disarm(world: World) -> int:
    """Work on the mine here, rewarded when it is done."""
    robot, sea = world.robot, world.sea
    if sea.disarmed[robot.vertex]:
        return SUCCESS
    status = _work(world, MINE, world.rules.disarm_steps)
    if status == SUCCESS:
        sea.disarmed[robot.vertex] = True
        sea.reward += world.rules.reward[MINE]
    return status


@compiled
def pick_up(world: World) -> int:
    """Work on the object here; in the end the robot carries it."""
    robot, sea = world.robot, world.sea
    if robot.carrying:
        return FAILURE
    status = _work(world, OBJECT, world.rules.pick_up_steps)
    if status == SUCCESS:
        robot.carrying = True
        robot.belief[OBJECT, robot.vertex] = world.rules.impossible
        sea.content[robot.vertex] = NOTHING
        sea.reward += world.rules.pick_up_reward
    return status


@compiled
def _work(world: World, kind: int, steps: int) -> int:
    """One step of work on the thing here; fails, and the robot knows better, when there is none."""
    robot = world.robot
    if world.sea.content[robot.vertex] != kind:
        robot.belief[kind, robot.vertex] = world.rules.impossible
        return FAILURE
    robot.work += 1
    return SUCCESS if robot.work >= steps else RUNNING


@compiled
def take_to_drop_off(world: World) -> int:
    """Go there with the object, and put it down for a reward."""
    robot = world.robot
    if not robot.carrying:
        return FAILURE
    if robot.vertex != DROP_OFF:
        return go(world, DROP_OFF)
    robot.carrying = False
    world.sea.reward += world.rules.reward[OBJECT]
    return SUCCESS
