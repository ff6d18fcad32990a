"""The Santa Fe trail: pellets of food on a torus."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

Food: TypeAlias = NDArray[np.bool_]


@cache
def santa_fe_trail() -> Food:
    """(32, 32) where the 89 pellets lie, row by row from the north; the ant starts at (0, 0)."""
    food = read_trail(santa_fe_rows())
    food.flags.writeable = False
    return food


def read_trail(rows: Sequence[str]) -> Food:
    """Where the pellets lie, drawn as `#`."""
    return np.array([[sign == "#" for sign in row] for row in rows])


def santa_fe_rows() -> list[str]:
    """The trail as it is drawn, row by row from the north."""
    return files("grammarbt_toys").joinpath("santafe_trail.txt").read_text(encoding="utf-8").splitlines()
