"""Which view an environment gets: one made for it where its observation is a code or a picture, else a general one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gymnasium import spaces

from grammarbt_gymnasium.environment import Environment
from grammarbt_gymnasium.features import Choice, Feature, Flag, Values, View, space_view
from grammarbt_gymnasium.minigrid import is_minigrid, minigrid_view
from grammarbt_gymnasium.names import KNOWN


def view_of(environment: Environment) -> View:
    """How to read the environment's observations.

    Raises:
        DomainError: they cannot be read.
    """
    make = DECODED.get(environment.name)
    if make and isinstance(environment.env.observation_space, spaces.Discrete):
        return make(environment.env.unwrapped)
    if is_minigrid(environment.env.observation_space):
        return minigrid_view()
    known = KNOWN.get(environment.name)
    names, ordered = (known.features, known.ordered) if known else ((), False)
    return space_view(environment.env.observation_space, names, ordered=ordered)


def _cells(rows: int, columns: int) -> tuple[Choice, Choice]:
    return _count("row", rows), _count("column", columns)


def _count(name: str, n: int) -> Choice:
    return Choice(name, tuple(map(str, range(n))), ordered=True)


def frozen_lake_view(world: Any) -> View:  # noqa: ANN401 - gymnasium's worlds share no useful type
    """The cell, as row and column from the top left."""
    return View(_cells(world.nrow, world.ncol), lambda state: divmod(int(state), world.ncol))


def cliff_walking_view(world: Any) -> View:  # noqa: ANN401 - as above
    """The cell, as row and column from the top left."""
    rows, columns = world.shape
    return View(_cells(rows, columns), lambda state: divmod(int(state), columns))


PLACES = ("red", "green", "yellow", "blue")
DIRECTIONS = ("north", "south", "east", "west")


def taxi_view(world: Any) -> View:  # noqa: ANN401 - as above
    """The taxi's cell, where the passenger is and wants to go, and the way to the next of these places.

    The target is the passenger, or the destination once the passenger has got in.
    """
    features: tuple[Feature, ...] = (
        *_cells(5, 5),
        Choice("passenger", (*PLACES, "taxi")),
        Choice("destination", PLACES),
        Flag("at target"),
        *(Flag(f"target {direction}") for direction in DIRECTIONS),
        Flag("wall east"),
        Flag("wall west"),
    )

    def read(state: int) -> Values:
        row, column, passenger, destination = world.decode(int(state))
        to_row, to_column = world.locs[passenger if passenger < len(PLACES) else destination]
        way = (to_row < row, to_row > row, to_column > column, to_column < column)
        walls = (world.desc[row + 1, 2 * column + at] != b":" for at in (2, 0))
        return (row, column, passenger, destination, not any(way), *way, *walls)

    return View(features, read)


DECODED: dict[str, Callable[[Any], View]] = {
    "FrozenLake": frozen_lake_view,
    "CliffWalking": cliff_walking_view,
    "Taxi": taxi_view,
}
"""Worlds whose observation is one number that stands for several."""
