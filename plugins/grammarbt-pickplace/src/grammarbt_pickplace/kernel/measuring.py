"""Measuring: where the robot believes to be, where a held cube is, and all distances."""

from __future__ import annotations

import math

from grammarbt_pickplace.constants import CUBE, ESTIMATE, FACING, GOAL
from grammarbt_pickplace.kernel.chance import uniform
from grammarbt_pickplace.program import compiled
from grammarbt_pickplace.state import NOTHING, Record


@compiled
def update(state: Record) -> None:
    """Estimate the pose anew, carry a held cube along, and measure all distances."""
    for axis in range(2):
        noise = uniform(state, ESTIMATE + axis)
        drifted = state.estimate[axis] + 1.5 + noise
        state.estimate[axis] = state.pose[axis] + 0.1 * noise if state.localised else drifted
    if state.held != NOTHING:
        _carry(state)
    measure(state)


@compiled
def _carry(state: Record) -> None:
    """The held cube is in front of the robot, wherever that is."""
    for axis in range(2):
        noise = 0.2 * uniform(state, CUBE + axis) - 0.1
        state.cube[state.held, axis] = state.pose[axis] + 0.3 * FACING[state.place, axis] + noise
    state.cube[state.held, 2] = 1.3 + 0.1 * uniform(state, CUBE + 2)


@compiled
def measure(state: Record) -> None:
    """Measure all distances."""
    state.error = length(state.estimate[0] - state.pose[0], state.estimate[1] - state.pose[1], 0.0)
    for cube in range(state.cubes):
        x, y, z = state.cube[cube]
        state.to_goal[cube] = length(x - GOAL[0], y - GOAL[1], z - GOAL[2])
        state.to_robot[cube] = length(x - state.pose[0], y - state.pose[1], 0.0)


@compiled
def length(x: float, y: float, z: float) -> float:
    """The length of a vector."""
    return math.sqrt(x * x + y * y + z * z)
