"""MiniGrid's picture, put into words: what is next to the robot, what it carries, and where things are that it sees.

An observation's picture is (columns, rows, 3): the robot stands in the middle of the last row and looks towards the first;
each cell holds MiniGrid's numbers of an object, its colour and its state. What the robot carries is drawn where it stands.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from gymnasium import spaces

from grammarbt_gymnasium.features import Choice, Values, View

OBJECTS = ("unseen", "empty", "wall", "floor", "door", "key", "ball", "box", "goal", "lava", "agent")
"""In the order of MiniGrid's numbers."""
DOOR, OPEN = OBJECTS.index("door"), 0
CELLS = ("wall", "nothing", "door", "open door", "key", "ball", "box", "goal", "lava")
"""What is next to the robot, as far as that matters; a door that stands open is no obstacle."""
ALIKE = {"unseen": "wall", "empty": "nothing", "floor": "nothing", "agent": "nothing"}
CELL_OF = tuple(CELLS.index(ALIKE.get(name, name)) for name in OBJECTS)
CARRIED = ("nothing", "key", "ball", "box")
CARRIED_OF = tuple(CARRIED.index(name) if name in CARRIED else 0 for name in OBJECTS)
SOUGHT = ("goal", "key", "door", "ball", "box")
SOUGHT_AT = {OBJECTS.index(name): at for at, name in enumerate(SOUGHT)}
SIDES = ("nowhere", "ahead", "left", "right")
HEADINGS = ("east", "south", "west", "north")


def is_minigrid(space: spaces.Space[Any]) -> bool:
    """Whether observations are MiniGrid's."""
    if not (isinstance(space, spaces.Dict) and {"image", "direction"} <= set(space.spaces)):
        return False
    shape = space["image"].shape
    return shape is not None and len(shape) == 3 and shape[2] == 3  # noqa: PLR2004 - columns, rows and three numbers


def minigrid_view() -> View:
    """The words, from observations alone."""
    features = (
        *(Choice(name, CELLS) for name in ("front", "left", "right")),
        Choice("carrying", CARRIED),
        Choice("heading", HEADINGS),
        *(Choice(name, SIDES) for name in SOUGHT),
    )
    return View(features, _read)


def _read(seen: Any) -> Values:  # noqa: ANN401 - gymnasium's observations share no useful type
    image = seen["image"]
    columns, rows, _ = image.shape
    middle, last = columns // 2, rows - 1
    around = ((middle, last - 1), (middle - 1, last), (middle + 1, last))
    sides = [0] * len(SOUGHT)
    objects = image[:, :, 0].tolist()
    for column, row, side in _cells_by_distance(columns, rows):
        at = SOUGHT_AT.get(objects[column][row])
        if at is not None and not sides[at]:
            sides[at] = side
    return [
        *(_cell(objects[column][row], int(image[column, row, 2])) for column, row in around),
        CARRIED_OF[objects[middle][last]],
        int(seen["direction"]),
        *sides,
    ]


def _cell(kind: int, state: int) -> int:
    return CELLS.index("open door") if kind == DOOR and state == OPEN else CELL_OF[kind]


@lru_cache(maxsize=8)
def _cells_by_distance(columns: int, rows: int) -> tuple[tuple[int, int, int], ...]:
    """Column, row and side of each cell but the robot's own, the nearest first."""
    middle, last = columns // 2, rows - 1
    cells = [(column, row) for column in range(columns) for row in range(rows) if (column, row) != (middle, last)]
    cells.sort(key=lambda cell: (abs(cell[0] - middle) + last - cell[1], cell))
    return tuple((column, row, _side(column - middle)) for column, row in cells)


def _side(aside: int) -> int:
    return SIDES.index("ahead" if not aside else "left" if aside < 0 else "right")
