"""The simulator: what each leaf does to the world, compiled.

The rules of time. The robot senses at the start and after every step. An action takes one step, failing ones too; only
`go to comms` takes none when already in comms. A tick in which nothing took a step costs one. The episode ends with the
horizon's last step, also in the middle of a tick.

Where the scenario's definition left a choice: Among equally near vertices the lowest number is the nearest. Work on a
mine or an object goes on after an interruption, but is lost when the robot leaves the vertex. Where a robot tried to
disarm or pick up something that is not there, it never believes in it again. A reported vertex is neither found nor
likely any more.

Chance is a function of (scenario, step, what it decides), not a stream: trees that have done the same so far go on to
see the same, and what a sensor shows of a vertex at a step is the same for every tree.

All compiled functions stand in this one file, because numba's cache notices a change only in the file of the function
that is called.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeVar, cast

import numba
import numpy as np
from numpy.typing import NDArray

from grammarbt.bt import Status
from grammarbt.domain import Scenarios
from grammarbt_marine.records import Floats, Records
from grammarbt_marine.state import MINE, NOTHING, OBJECT, TARGET, World
from grammarbt_marine.world import DROP_OFF, START

LEAVES = (
    *("go to comms", "report", "disarm", "pick up", "take to drop off"),
    *("go to likely target", "random walk", "shortest path"),
    *("in comms", "target found", "at surface", "mine found", "is armed"),
    *("object found", "carrying object", "likely target found"),
)
"""What the kernel knows, actions first; a leaf's place here is its code in a program."""

GO_TO_COMMS, REPORT, DISARM, PICK_UP, TAKE_TO_DROP_OFF, GO_TO_LIKELY_TARGET, RANDOM_WALK, SHORTEST_PATH = range(8)
IN_COMMS, TARGET_FOUND, AT_SURFACE, MINE_FOUND, IS_ARMED, OBJECT_FOUND, CARRYING_OBJECT, LIKELY_TARGET_FOUND = range(
    8, 16
)

FAILURE, SUCCESS, RUNNING = int(Status.FAILURE), int(Status.SUCCESS), int(Status.RUNNING)
PLACING, SENSING, WALKING = range(3)

ENTRY = np.dtype([("leaf", np.int32), ("occurrence", np.int32), ("follow", np.int32, (3,))], align=True)
"""An entry of a program: its leaf's code, its occurrence, and by status the next entry or the end of the tick."""


class Program(NamedTuple):
    """A policy with the kernel's codes: (E,) entries of dtype `ENTRY`, and how many leaves the tree has."""

    entries: Records
    occurrences: int


Function = TypeVar("Function", bound=Callable[..., object])


def compiled(function: Function) -> Function:
    """`numba.njit`, cached on disk, that keeps the function's type."""
    return cast("Function", numba.njit(cache=True)(function))


@compiled
def simulate(
    program: Program, states: Records, roadmaps: Records, rules: Records, scenarios: Scenarios
) -> tuple[Floats, NDArray[np.int64]]:
    """Run an episode per scenario.

    Args:
        program: what the robot does.
        states: one record of `State`, overwritten.
        roadmaps: records of `Roadmap`.
        rules: one record of `Rules`.
        scenarios: (n,) scenario i uses roadmap i modulo the number of roadmaps.

    Returns:
        The return of each episode, and by occurrence the ticks of all episodes together.
    """
    returns = np.empty(scenarios.size, dtype=np.float64)
    ticks = np.zeros(program.occurrences, dtype=np.int64)
    for index in range(scenarios.size):
        scenario = scenarios[index]
        world = World(states[0], roadmaps[scenario % roadmaps.size], rules[0])
        _begin(world, scenario)
        while world.state.step < world.rules.horizon:
            _tick(program.entries, world, ticks)
        returns[index] = world.state.reward
    return returns, ticks


@compiled
def _tick(entries: Records, world: World, ticks: NDArray[np.int64]) -> None:
    before = world.state.step
    at = 0
    while at >= 0 and world.state.step < world.rules.horizon:
        entry = entries[at]
        ticks[entry.occurrence] += 1
        at = entry.follow[_visit(world, entry.leaf)]
    if world.state.step == before:
        _pass_step(world)


@compiled
def _visit(world: World, leaf: int) -> int:
    if leaf < IN_COMMS:
        return _act(world, leaf)
    return SUCCESS if _holds(world, leaf) else FAILURE


@compiled
def _begin(world: World, scenario: int) -> None:
    state = world.state
    state.key = _mix(np.uint64(scenario))
    state.step = state.work = 0
    state.reward = 0.0
    state.carrying = False
    state.content[:] = NOTHING
    for kind in range(3):
        state.belief[kind, :] = world.rules.prior[kind]
    state.visited[:] = state.reported[:] = state.disarmed[:] = False
    _place_things(world)
    _move(world, START)
    _sense(world)


@compiled
def _place_things(world: World) -> None:
    """Shuffle as many vertices as there are things, the start and the drop-off left out."""
    free = np.arange(DROP_OFF + 1, world.state.content.size)
    placed = 0
    for kind in range(3):
        for _ in range(world.rules.count[kind]):
            other = placed + int(_uniform(world.state.key, 0, PLACING, placed) * (free.size - placed))
            free[placed], free[other] = free[other], free[placed]
            world.state.content[free[placed]] = kind
            placed += 1


@compiled
def _uniform(key: np.uint64, step: int, decides: int, item: int) -> float:
    """A number from 0 to below 1, with 53 random bits."""
    counter = np.uint64((decides << 48) + (step << 24) + item)
    return float(_mix(key + counter) >> np.uint64(11)) * 2.0**-53


@compiled
def _mix(number: np.uint64) -> np.uint64:
    """Scramble 64 bits (the SplitMix64 generator of Steele, Lea and Flood, 2014)."""
    number = (number + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    number = (number ^ (number >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    number = (number ^ (number >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return number ^ (number >> np.uint64(31))


@compiled
def _pass_step(world: World) -> None:
    world.state.step += 1
    _sense(world)


@compiled
def _sense(world: World) -> None:
    """Look for each class at every vertex in range, and update the belief by Bayes' rule."""
    state, roadmap = world.state, world.roadmap
    here = state.vertex
    for place in range(roadmap.reach[here]):
        vertex = roadmap.in_range[here, place]
        for kind in range(3):
            present = state.content[vertex] == kind
            chance = roadmap.detection[here, place, kind] if present else world.rules.false_alarm[kind]
            detected = _uniform(state.key, state.step, SENSING, vertex * 3 + kind) < chance
            state.belief[kind, vertex] += (
                roadmap.gain[here, place, kind] if detected else roadmap.loss[here, place, kind]
            )


@compiled
def _holds(world: World, condition: int) -> bool:
    state = world.state
    if condition == IN_COMMS:
        answer = bool(world.roadmap.comms[state.vertex])
    elif condition == TARGET_FOUND:
        answer = _target_found(world)
    elif condition == AT_SURFACE:
        answer = bool(world.roadmap.surface[state.vertex])
    elif condition == MINE_FOUND:
        answer = _found(world, MINE, state.vertex)
    elif condition == IS_ARMED:
        answer = not state.disarmed[state.vertex]
    elif condition == OBJECT_FOUND:
        answer = bool(state.carrying) or _found(world, OBJECT, state.vertex)
    elif condition == CARRYING_OBJECT:
        answer = bool(state.carrying)
    else:
        answer = _nearest_likely_target(world) != NOTHING
    return answer


@compiled
def _found(world: World, kind: int, vertex: int) -> bool:
    return bool(world.state.belief[kind, vertex] > world.rules.found[kind])


@compiled
def _target_found(world: World) -> bool:
    for vertex in range(world.state.content.size):
        if _found(world, TARGET, vertex) and not world.state.reported[vertex]:
            return True
    return False


@compiled
def _act(world: World, action: int) -> int:
    """Do at most one step of the action; the step passes after its effect."""
    here = world.state.vertex
    if action == GO_TO_COMMS and world.roadmap.comms[here]:
        return SUCCESS
    if action == GO_TO_COMMS:
        status = _go(world, world.roadmap.nearest_comms[here])
    elif action == REPORT:
        status = _report(world)
    elif action == DISARM:
        status = _disarm(world)
    elif action == PICK_UP:
        status = _pick_up(world)
    elif action == TAKE_TO_DROP_OFF:
        status = _take_to_drop_off(world)
    elif action == GO_TO_LIKELY_TARGET:
        status = _go(world, _nearest_likely_target(world))
    elif action == RANDOM_WALK:
        status = _random_walk(world)
    else:
        status = _go(world, _nearest_unvisited(world))
    _pass_step(world)
    return status


@compiled
def _go(world: World, goal: int) -> int:
    """Move one edge towards the goal, or stay there; fails without a goal."""
    if goal == NOTHING:
        return FAILURE
    _move(world, world.roadmap.next_hop[world.state.vertex, goal])
    return RUNNING


@compiled
def _move(world: World, vertex: int) -> None:
    state = world.state
    if vertex != state.vertex:
        state.work = 0
    state.vertex = vertex
    state.visited[vertex] = True


@compiled
def _nearest_likely_target(world: World) -> int:
    state, rules = world.state, world.rules
    hops = world.roadmap.hops[state.vertex]
    nearest = NOTHING
    for vertex in range(hops.size):
        likely = rules.likely < state.belief[TARGET, vertex] <= rules.found[TARGET] and not state.reported[vertex]
        if likely and (nearest == NOTHING or hops[vertex] < hops[nearest]):
            nearest = vertex
    return nearest


@compiled
def _nearest_unvisited(world: World) -> int:
    hops = world.roadmap.hops[world.state.vertex]
    nearest = NOTHING
    for vertex in range(hops.size):
        if not world.state.visited[vertex] and (nearest == NOTHING or hops[vertex] < hops[nearest]):
            nearest = vertex
    return nearest


@compiled
def _random_walk(world: World) -> int:
    state = world.state
    edge = int(_uniform(state.key, state.step, WALKING, 0) * world.roadmap.degree[state.vertex])
    _move(world, world.roadmap.neighbours[state.vertex, edge])
    return RUNNING


@compiled
def _report(world: World) -> int:
    """Report every vertex where a target was found; only the right ones are rewarded."""
    state = world.state
    if not world.roadmap.comms[state.vertex]:
        return FAILURE
    for vertex in range(state.content.size):
        if _found(world, TARGET, vertex) and not state.reported[vertex]:
            state.reported[vertex] = True
            if state.content[vertex] == TARGET:
                state.reward += world.rules.reward[TARGET]
    return SUCCESS


@compiled
def _disarm(world: World) -> int:
    state = world.state
    if state.disarmed[state.vertex]:
        return SUCCESS
    status = _work(world, MINE, world.rules.disarm_steps)
    if status == SUCCESS:
        state.disarmed[state.vertex] = True
        state.reward += world.rules.reward[MINE]
    return status


@compiled
def _pick_up(world: World) -> int:
    state = world.state
    if state.carrying:
        return FAILURE
    status = _work(world, OBJECT, world.rules.pick_up_steps)
    if status == SUCCESS:
        state.carrying = True
        state.content[state.vertex] = NOTHING
        state.belief[OBJECT, state.vertex] = -np.inf
    return status


@compiled
def _work(world: World, kind: int, steps: int) -> int:
    """One step of work on the thing here; fails, and the robot knows better, when there is none."""
    state = world.state
    if state.content[state.vertex] != kind:
        state.belief[kind, state.vertex] = -np.inf
        return FAILURE
    state.work += 1
    return SUCCESS if state.work >= steps else RUNNING


@compiled
def _take_to_drop_off(world: World) -> int:
    state = world.state
    if not state.carrying:
        return FAILURE
    if state.vertex != DROP_OFF:
        return _go(world, DROP_OFF)
    state.carrying = False
    state.reward += world.rules.reward[OBJECT]
    return SUCCESS
