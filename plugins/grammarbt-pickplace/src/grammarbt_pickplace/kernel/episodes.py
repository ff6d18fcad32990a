"""Episodes: how a run begins, what a tick of the tree is, and what a run is worth."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grammarbt.domain import Returns, Scenarios
from grammarbt_pickplace.constants import ENOUGH_SUCCESSES, FIRST_ESTIMATE, MAX_FAILURES, MAX_TICKS, POSES, SPAWN
from grammarbt_pickplace.kernel.chance import scenario_key
from grammarbt_pickplace.kernel.leaves import visit
from grammarbt_pickplace.kernel.measuring import measure
from grammarbt_pickplace.program import FAILED, SUCCEEDED, Program, cached, compiled
from grammarbt_pickplace.state import FRESH, NOTHING, STRETCHED, Record, Records


@cached
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
            state[0].key = scenario_key(scenarios[index])
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
    measure(state)


@compiled
def _run(entries: Records, state: Record, memory: Records, ticks: NDArray[np.int64]) -> None:
    failures = successes = 0
    while state.tick < MAX_TICKS and failures < MAX_FAILURES and successes < ENOUGH_SUCCESSES:
        state.tick += 1
        at = 0
        while at >= 0:
            entry = entries[at]
            ticks[entry.occurrence] += 1
            at = entry.follow[visit(state, memory[entry.occurrence], entry.leaf)]
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
