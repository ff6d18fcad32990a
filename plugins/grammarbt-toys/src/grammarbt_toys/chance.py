"""Chance as a function of the scenario and of what is decided, not a stream: all trees meet the same luck."""

from __future__ import annotations

import numpy as np

from grammarbt_toys.program import compiled


@compiled
def uniform(scenario: int, step: int, item: int) -> float:
    """A number from 0 to below 1 for decision number `item` of a step; items are below 2^24."""
    counter = np.uint64((step << 24) + item)
    return float(_mix(_mix(np.uint64(scenario)) + counter) >> np.uint64(11)) * 2.0**-53


@compiled
def _mix(number: np.uint64) -> np.uint64:
    """Scramble 64 bits (the SplitMix64 generator of Steele, Lea and Flood, 2014)."""
    number = (number + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    number = (number ^ (number >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    number = (number ^ (number >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return number ^ (number >> np.uint64(31))
