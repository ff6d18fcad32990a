"""The simulator: what each leaf does to the robot and the cubes, compiled.

An action node takes at least two ticks: in the first it begins and is RUNNING, in the next it acts, and the answer it
then gives it keeps giving. It begins again when it was not RUNNING in the tick before and its effect does not hold. Head
up counts as in effect while the arm is at work, head down while a move is: else a tree that raises the head to drive
and lowers it to pick would do nothing but nod. At work means begun and not yet done, also when interrupted.

Where the published definition leaves a choice: A robot that drops its cube or loses its way on a move stops half-way
between where it believed to be and where it was going; it may lose its way without a cube too. A cube can only be put on
its goal: to put it back on a pick table takes a tucked arm, and tucking loses the cube.

Chance is a function of (scenario, run, actions done, what it decides), not a stream: trees that have done the same so
far go on to see the same.

All compiled functions and their numbers stand in this one file, because numba's cache notices a change only in the file
of the function that is called.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, TypeVar, cast

import numba
import numpy as np
from numpy.typing import NDArray

from grammarbt.bt import Status
from grammarbt.domain import Returns, Scenarios
from grammarbt_pickplace.state import Record, Records

LEAVES = (
    *("move to pick0", "move to pick1", "move to pick2", "move to place"),
    *("tuck", "pick", "place", "localise", "head up", "head down"),
    *("have block", "task done", "cube0 placed", "cube1 placed", "cube2 placed"),
    *("table0 visited", "table1 visited", "table2 visited"),
)
"""What the kernel knows, actions first; a leaf's place here is its code in a program."""

MOVE_TO_PLACE, TUCK, PICK, PLACE, LOCALISE, HEAD_UP, HEAD_DOWN = range(3, 10)
HAVE_BLOCK, TASK_DONE, CUBE0_PLACED = range(10, 13)
TABLE0_VISITED = 15

PLACE_TABLE, SPAWN, ELSEWHERE = 3, 4, 5
"""Places after the pick tables 0 to 2; the code of a move is that of the place where it leads."""
POSES = np.array([(-1.148, -6.1), (-2.32, -10.52), (-0.54, -0.545), (2.6009, -1.7615), (2.4, -11.0)])
FACING = np.array([(0.0, -1.0), (0.0, -1.0), (-1.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 0.0)])
GOAL = np.array([3.1509, -1.7615, 0.8625])
FIRST_ESTIMATE = np.array([-0.03343, -0.0321])

STRETCHED, TUCKED, AT_PICK, AT_PLACE = range(4)
NOTHING = -1

MAX_TICKS, MAX_FAILURES, ENOUGH_SUCCESSES = 60, 5, 2
SPEED, REACH = 0.3, 0.8
SECONDS = np.array([0.0, 0.0, 0.0, 0.0, 3.0, 12.0, 5.0, 7.0, 2.0, 2.0])
"""How long actions take, by code; a move takes as long as its way."""
PICK_FAILS, PLACE_FAILS, LOCALISE_FAILS, DROPPED, LOST = 0.2, 0.1, 0.2, 0.05, 0.1

FAILURE, SUCCESS, RUNNING, FRESH = int(Status.FAILURE), int(Status.SUCCESS), int(Status.RUNNING), -1
SUCCEEDED, FAILED = -1, -2
"""Ends of a tick, in the place of a next entry."""

ESTIMATE, CUBE, OUTCOME, DROPPING, LOSING, LOST_ESTIMATE = 0, 2, 5, 6, 7, 8
"""What chance decides; coordinates count on from the first."""

ENTRY = np.dtype([("leaf", np.int32), ("occurrence", np.int32), ("follow", np.int32, (3,))], align=True)
"""An entry of a program: its leaf's code, its occurrence, and by status the next entry or the end of the tick."""


class Program(NamedTuple):
    """A policy with the kernel's codes: (E,) entries of dtype `ENTRY`, and the number of nodes of the tree."""

    entries: Records
    nodes: int


Function = TypeVar("Function", bound=Callable[..., object])


def compiled(function: Function) -> Function:
    """`numba.njit`, cached on disk, that keeps the function's type."""
    return cast("Function", numba.njit(cache=True)(function))


@compiled
def simulate(
    program: Program, state: Records, memory: Records, starts: NDArray[np.float64], scenarios: Scenarios
) -> tuple[Returns, NDArray[np.int64]]:
    """Run an episode per scenario.

    Args:
        program: what the robot does.
        state: one record of dtype `STATE`, overwritten except for `stochastic`.
        memory: (occurrences,) records of dtype `MEMORY`, overwritten.
        starts: (runs, cubes, 3) where the cubes start in each run of an episode.
        scenarios: (n,) each fixes all chance of an episode.

    Returns:
        The return of each episode, the mean over its runs, and by occurrence the ticks of all episodes together.
    """
    returns = np.zeros(scenarios.size, dtype=np.float64)
    ticks = np.zeros(memory.size, dtype=np.int64)
    for index in range(scenarios.size):
        for run in range(len(starts)):
            _begin(state[0], memory, starts[run])
            state[0].key = _mix(np.uint64(scenarios[index]))
            state[0].run = run
            _run(program.entries, state[0], memory, ticks)
            returns[index] += _score(state[0], program.nodes)
        returns[index] /= len(starts)
    return returns, ticks


@compiled
def _begin(state: Record, memory: Records, starts: NDArray[np.float64]) -> None:
    for occurrence in range(memory.size):
        memory[occurrence].status = memory[occurrence].running = FRESH
    state.tick = state.acts = 0
    state.time = 0.0
    state.place = SPAWN
    state.pose[:] = POSES[SPAWN]
    state.estimate[:] = FIRST_ESTIMATE
    state.localised = state.head_up = state.moving = state.handling = False
    state.visited[:] = False
    state.arm = STRETCHED
    state.held = NOTHING
    state.cubes = len(starts)
    for cube in range(state.cubes):
        state.start[cube] = starts[cube]
        state.cube[cube] = starts[cube]
    _measure(state)


@compiled
def _run(entries: Records, state: Record, memory: Records, ticks: NDArray[np.int64]) -> None:
    failures = successes = 0
    while state.tick < MAX_TICKS and failures < MAX_FAILURES and successes < ENOUGH_SUCCESSES:
        state.tick += 1
        at = 0
        while at >= 0:
            entry = entries[at]
            ticks[entry.occurrence] += 1
            at = entry.follow[_visit(state, memory[entry.occurrence], entry.leaf)]
        failures += at == FAILED
        successes = successes + 1 if at == SUCCEEDED else 0


@compiled
def _score(state: Record, nodes: int) -> float:
    """The published return: minus what the tree, the time and every distance cost, and a fine for cubes not placed."""
    to_goal = to_robot = 0.0
    placed = 0
    for cube in range(state.cubes):
        to_goal += state.to_goal[cube]
        to_robot += state.to_robot[cube]
        placed += state.to_goal[cube] == 0.0
    cost = 0.5 * nodes + 0.1 * state.time
    cost += 10.0 * to_goal * to_goal + state.error * state.error + 2.0 * to_robot * to_robot
    if placed < state.cubes:
        cost += 300.0 - 100.0 * placed - 50.0 * (state.held != NOTHING)
    return float(-cost)


@compiled
def _visit(state: Record, memory: Record, leaf: int) -> int:
    if leaf >= HAVE_BLOCK:
        return SUCCESS if _holds(state, leaf) else FAILURE
    if memory.running != state.tick - 1 and not _in_effect(state, leaf):
        memory.status = FRESH
    if memory.status == FRESH:
        _set_at_work(state, leaf, at_work=True)
        memory.status = RUNNING
    elif memory.status == RUNNING:
        _set_at_work(state, leaf, at_work=False)
        memory.status = SUCCESS if _act(state, leaf) else FAILURE
    if memory.status == RUNNING:
        memory.running = state.tick
    return int(memory.status)


@compiled
def _holds(state: Record, condition: int) -> bool:
    if condition == HAVE_BLOCK:
        answer = state.held != NOTHING
    elif condition == TASK_DONE:
        answer = state.to_goal[: state.cubes].max() == 0.0
    elif condition < TABLE0_VISITED:
        answer = state.to_goal[condition - CUBE0_PLACED] == 0.0 and state.held == NOTHING
    else:
        answer = state.visited[condition - TABLE0_VISITED] != 0
    return bool(answer)


@compiled
def _in_effect(state: Record, action: int) -> bool:
    """Whether the action's effect holds, so that its node keeps its answer."""
    if action <= MOVE_TO_PLACE:
        answer = state.place == action
    elif action == TUCK:
        answer = state.arm == TUCKED
    elif action == PICK:
        answer = state.held != NOTHING
    elif action == PLACE:
        answer = state.held == NOTHING
    elif action == LOCALISE:
        answer = state.localised != 0
    elif action == HEAD_UP:
        answer = state.head_up != 0 or state.handling != 0
    else:
        answer = state.head_up == 0 or state.moving != 0
    return bool(answer)


@compiled
def _set_at_work(state: Record, action: int, at_work: bool) -> None:
    if action <= MOVE_TO_PLACE:
        state.moving = at_work
    elif action <= PLACE:
        state.handling = at_work


@compiled
def _act(state: Record, action: int) -> bool:
    """Do the action, and let its time pass; whether it succeeded."""
    state.acts += 1
    state.time += SECONDS[action]
    success = True
    if action >= HEAD_UP:
        state.head_up = action == HEAD_UP
        return success
    if action <= MOVE_TO_PLACE:
        success = _move(state, action)
    elif action == TUCK:
        state.arm = TUCKED
        _lose_cube(state)
    elif action == PICK:
        success = _pick(state)
    elif action == PLACE:
        success = _place(state)
    else:
        success = not _goes_wrong(state, OUTCOME, LOCALISE_FAILS)
        state.localised = success
    _update(state)
    return success


@compiled
def _move(state: Record, place: int) -> bool:
    """Drive to a place; takes the time from where the robot believed to be."""
    x, y = state.estimate[0], state.estimate[1]
    ready = state.localised != 0 and state.head_up != 0 and state.arm in (TUCKED, AT_PICK)
    if ready and state.place != place:
        _drive(state, place)
    state.time += _length(state.pose[0] - x, state.pose[1] - y, 0.0) / SPEED
    return bool(state.place == place)


@compiled
def _drive(state: Record, place: int) -> None:
    dropped = state.held != NOTHING and _goes_wrong(state, DROPPING, DROPPED)
    lost = _goes_wrong(state, LOSING, LOST)
    state.place = ELSEWHERE if dropped or lost else place
    for axis in range(2):
        goal = POSES[place, axis]
        state.pose[axis] = (state.estimate[axis] + goal) / 2.0 if dropped or lost else goal
    if dropped:
        _lose_cube(state)
    if lost:
        state.localised = False
        for axis in range(2):
            state.estimate[axis] = state.pose[axis] + 0.1 * _uniform(state, LOST_ESTIMATE + axis)


@compiled
def _pick(state: Record) -> bool:
    nearest = state.to_robot[: state.cubes].argmin()
    ready = state.localised != 0 and state.head_up == 0 and state.arm == TUCKED and state.place <= PLACE_TABLE
    success = ready and state.to_robot[nearest] < REACH and not _goes_wrong(state, OUTCOME, PICK_FAILS)
    if success:
        state.held = nearest
        state.arm = AT_PICK
    if state.place < PLACE_TABLE:
        state.visited[state.place] = True
    return bool(success)


@compiled
def _place(state: Record) -> bool:
    ready = state.held != NOTHING and state.localised != 0 and state.head_up == 0 and state.place == PLACE_TABLE
    success = ready and not _goes_wrong(state, OUTCOME, PLACE_FAILS)
    if success:
        state.cube[state.held] = GOAL
        state.held = NOTHING
        state.arm = AT_PLACE
    return bool(success)


@compiled
def _lose_cube(state: Record) -> None:
    """A held cube goes back to its start."""
    if state.held != NOTHING:
        state.cube[state.held] = state.start[state.held]
        state.held = NOTHING


@compiled
def _update(state: Record) -> None:
    """Estimate the pose anew, carry a held cube along, and measure all distances."""
    for axis in range(2):
        noise = _uniform(state, ESTIMATE + axis)
        drifted = state.estimate[axis] + 1.5 + noise
        state.estimate[axis] = state.pose[axis] + 0.1 * noise if state.localised else drifted
    if state.held != NOTHING:
        for axis in range(2):
            noise = 0.2 * _uniform(state, CUBE + axis) - 0.1
            state.cube[state.held, axis] = state.pose[axis] + 0.3 * FACING[state.place, axis] + noise
        state.cube[state.held, 2] = 1.3 + 0.1 * _uniform(state, CUBE + 2)
    _measure(state)


@compiled
def _measure(state: Record) -> None:
    state.error = _length(state.estimate[0] - state.pose[0], state.estimate[1] - state.pose[1], 0.0)
    for cube in range(state.cubes):
        x, y, z = state.cube[cube]
        state.to_goal[cube] = _length(x - GOAL[0], y - GOAL[1], z - GOAL[2])
        state.to_robot[cube] = _length(x - state.pose[0], y - state.pose[1], 0.0)


@compiled
def _length(x: float, y: float, z: float) -> float:
    return math.sqrt(x * x + y * y + z * z)


@compiled
def _goes_wrong(state: Record, decides: int, probability: float) -> bool:
    return bool(state.stochastic != 0 and _uniform(state, decides) < probability)


@compiled
def _uniform(state: Record, decides: int) -> float:
    """A number from 0 to below 1, with 53 random bits."""
    counter = np.uint64((state.run << 48) + (state.acts << 16) + decides)
    return float(_mix(state.key + counter) >> np.uint64(11)) * 2.0**-53


@compiled
def _mix(number: np.uint64) -> np.uint64:
    """Scramble 64 bits (the SplitMix64 generator of Steele, Lea and Flood, 2014)."""
    number = (number + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    number = (number ^ (number >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    number = (number ^ (number >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return number ^ (number >> np.uint64(31))
