"""Chance as a function of (scenario, robot, step, what it decides), not a stream.

Trees that have done the same so far go on to see the same, and what a sensor shows of a vertex at a step is the same for
every tree.
"""

from __future__ import annotations

import numpy as np

from grammarbt_marine.program import compiled
from grammarbt_marine.state import World


@compiled
def robot_key(scenario: int, number: int) -> np.uint64:
    """What makes the chance of a scenario's robot its own."""
    return _mix(np.uint64(scenario)) + (np.uint64(number) << np.uint64(56))


@compiled
def uniform(world: World, decides: int, item: int) -> float:
    """A number from 0 to below 1, with 53 random bits."""
    counter = np.uint64((decides << 48) + (world.sea.step << 24) + item)
    return float(_mix(world.robot.key + counter) >> np.uint64(11)) * 2.0**-53


@compiled
def _mix(number: np.uint64) -> np.uint64:
    """Scramble 64 bits (the SplitMix64 generator of Steele, Lea and Flood, 2014)."""
    number = (number + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    number = (number ^ (number >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    number = (number ^ (number >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return number ^ (number >> np.uint64(31))
