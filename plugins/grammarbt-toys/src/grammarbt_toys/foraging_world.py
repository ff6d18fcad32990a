"""The world of a swarm as compiled functions see it."""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

UNKNOWN = -1

ROBOT = np.dtype(
    [
        ("row", np.int64),
        ("column", np.int64),
        ("down", np.int64),  # the step that it explores along
        ("right", np.int64),
        ("carrying", np.int64),  # whether it carries a piece of food
        ("moved", np.int64),  # whether it has moved in this tick
        ("knows_hub", np.int64),  # whether it has seen the hub
        ("site_row", np.int64),  # where it last saw a site, UNKNOWN where it has not
        ("site_column", np.int64),
    ],
    align=True,
)
"""A robot; compiled functions hand a record on as one pointer."""

Robot: TypeAlias = Any
"""One record: NumPy's type knows no fields by name."""


class World(NamedTuple):
    """R robots on a square of N cells a side, with the hub in its middle.

    Attributes:
        food: (N, N) pieces that lie in each cell.
        piles: (P, 2) the cells with food; only the first `filled[0]` mean anything.
        filled: (1,) how many cells have food.
        sites: (S, 2) cells at which food lay at the start.
        robots: (R,) records of dtype `ROBOT`.
        sight: cells that a robot sees to each side.
    """

    food: NDArray[np.int64]
    piles: NDArray[np.int64]
    filled: NDArray[np.int64]
    sites: NDArray[np.int64]
    robots: NDArray[np.void]
    sight: int


def make_world(size: int, robots: int, sites: int, food: int, sight: int) -> World:
    """Room for a world, to be filled when an episode begins; `food` counts the pieces at each site."""
    return World(
        food=np.zeros((size, size), dtype=np.int64),
        piles=np.zeros((min(sites * food, size * size), 2), dtype=np.int64),
        filled=np.zeros(1, dtype=np.int64),
        sites=np.zeros((sites, 2), dtype=np.int64),
        robots=np.zeros(robots, dtype=ROBOT),
        sight=sight,
    )
