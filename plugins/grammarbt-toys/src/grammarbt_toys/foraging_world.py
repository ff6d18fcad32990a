"""The world of a swarm as compiled functions see it, how it begins, and where food lies in it."""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from grammarbt_toys.chance import uniform
from grammarbt_toys.program import inlined

UNKNOWN = -1
STAYING = 4
"""The number of the middle of nine directions, which leads nowhere."""
PLACING = 2**20
"""Decisions with this number and above place things; below, they are the robots'."""

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


@inlined
def begin(world: World, pieces: int, scenario: int) -> None:
    """Put the robots anywhere and the sites anywhere far from the hub."""
    size, item = len(world.food), PLACING
    world.food[:] = 0
    world.filled[0] = 0
    for number in range(len(world.robots)):
        robot = world.robots[number]
        robot.row, robot.column, item = _free_cell(size, 0, scenario, item)
        robot.down, robot.right = direction(uniform(scenario, 0, number))
        robot.carrying = robot.knows_hub = False
        robot.site_row = robot.site_column = UNKNOWN
    for site in range(len(world.sites)):
        row, column, item = _free_cell(size, size // 4, scenario, item)
        world.sites[site] = row, column
        add_food(world, row, column, pieces)


@inlined
def _free_cell(size: int, least: int, scenario: int, item: int) -> tuple[int, int, int]:
    """Draw a cell that is so far from the hub; gives it and the number of the next decision."""
    while True:
        row, column = int(uniform(scenario, 0, item) * size), int(uniform(scenario, 0, item + 1) * size)
        item += 2
        if max(abs(row - size // 2), abs(column - size // 2)) >= least:
            return row, column, item


@inlined
def direction(chance: float) -> tuple[int, int]:
    """One of the eight directions, row by row."""
    number = int(chance * 8)
    number += number >= STAYING
    return number // 3 - 1, number % 3 - 1


@inlined
def add_food(world: World, row: int, column: int, pieces: int) -> None:
    """Lay food into the cell."""
    if world.food[row, column] == 0:
        world.piles[world.filled[0]] = row, column
        world.filled[0] += 1
    world.food[row, column] += pieces


@inlined
def take_food(world: World, row: int, column: int) -> None:
    """Take a piece of food from the cell."""
    world.food[row, column] -= 1
    if world.food[row, column] == 0:
        pile = 0
        while world.piles[pile, 0] != row or world.piles[pile, 1] != column:
            pile += 1
        world.filled[0] -= 1
        world.piles[pile] = world.piles[world.filled[0]]
