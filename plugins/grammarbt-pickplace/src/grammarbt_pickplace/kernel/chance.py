"""Chance as a function of (scenario, run, actions done, what it decides), not a stream.

Trees that have done the same so far go on to see the same.
"""

from __future__ import annotations

import numpy as np

from grammarbt_pickplace.program import compiled
from grammarbt_pickplace.state import Record


@compiled
def scenario_key(scenario: int) -> np.uint64:
    """What makes the chance of a scenario its own."""
    return _mix(np.uint64(scenario))


@compiled
def goes_wrong(state: Record, decides: int, probability: float) -> bool:
    """Whether that happens; never where actions cannot go wrong."""
    return bool(state.stochastic != 0 and uniform(state, decides) < probability)


@compiled
def uniform(state: Record, decides: int) -> float:
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
