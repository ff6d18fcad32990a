"""Pictures of the worlds made of cells: the frozen lake, the cliff and the taxi's town."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from grammarbt.domain import Mark, Role
from grammarbt_gymnasium.features import Values
from grammarbt_gymnasium.scene import Scene, line
from grammarbt_gymnasium.views import PLACES

CELLS: dict[str, Role] = {"S": "place", "F": "ground", "H": "hazard", "G": "goal"}
"""The letters of the frozen lake's map: start, frozen, hole, goal."""


def frozen_lake_scene(world: Any) -> Scene:  # noqa: ANN401 - gymnasium's worlds share no useful type
    """The lake with its holes."""
    return _walk(["".join(cell.decode() for cell in row) for row in world.desc])


def cliff_walking_scene(world: Any) -> Scene:  # noqa: ANN401 - as above
    """The cliff along the bottom, from the start to the goal."""
    rows, columns = world.shape
    return _walk(["F" * columns] * (rows - 1) + ["S" + "H" * (columns - 2) + "G"])


def _walk(rows: Sequence[str]) -> Scene:
    """Someone who walks over cells; the features are row and column."""
    height = len(rows)
    cells = [
        _square(f"cell {row} {column}", CELLS[letter], row, column, height)
        for row, letters in enumerate(rows)
        for column, letter in enumerate(letters)
    ]

    def marks(values: Values) -> Iterator[Mark]:
        yield from cells
        yield Mark("walker", "circle", "robot", values[1] + 0.5, height - values[0] - 0.5, 0.6)

    return Scene((0.0, 0.0, float(len(rows[0])), float(height)), marks)


def taxi_scene(world: Any) -> Scene:  # noqa: ANN401 - as above
    """The town with its walls and four places; the passenger waits at one, or rides along."""
    size = 5
    cells = [
        _square(f"cell {row} {column}", "ground", row, column, size) for row in range(size) for column in range(size)
    ]
    walls = [
        line(f"wall {row} {column}", "hazard", (column + 1.0, size - row), (column + 1.0, size - row - 1.0), 0.08)
        for row in range(size)
        for column in range(size - 1)
        if world.desc[row + 1, 2 * column + 2] != b":"
    ]

    def marks(values: Values) -> Iterator[Mark]:
        row, column, passenger, destination = (int(value) for value in values[:4])
        yield from cells
        yield from walls
        for number, (name, (place_row, place_column)) in enumerate(zip(PLACES, world.locs, strict=True)):
            role: Role = "goal" if number == destination else "place"
            yield Mark(name, "square", role, place_column + 0.5, size - place_row - 0.5, 0.8, label=name)
        yield Mark("taxi", "square", "robot", column + 0.5, size - row - 0.5, 0.5)
        at_row, at_column = world.locs[passenger] if passenger < len(PLACES) else (row, column)
        yield Mark("passenger", "circle", "object", at_column + 0.5, size - at_row - 0.5, 0.3)

    return Scene((0.0, 0.0, float(size), float(size)), marks)


def _square(name: str, role: Role, row: int, column: int, height: int) -> Mark:
    return Mark(name, "square", role, column + 0.5, height - row - 0.5, 0.95)
