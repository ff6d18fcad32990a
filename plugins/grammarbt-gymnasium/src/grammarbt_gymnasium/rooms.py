"""Pictures of MiniGrid's worlds: rooms of cells, from the world itself, of which the robot sees only a part."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import pi
from typing import Any

from grammarbt.domain import Mark, Role, Shape
from grammarbt_gymnasium.features import Values
from grammarbt_gymnasium.minigrid import DOOR, OBJECTS, OPEN
from grammarbt_gymnasium.scene import Scene

LOOKS: dict[str, tuple[Shape, Role, float]] = {
    "wall": ("square", "place", 1.0),
    "floor": ("square", "path", 0.95),
    "door": ("square", "object", 0.9),
    "key": ("triangle", "object", 0.4),
    "ball": ("circle", "object", 0.5),
    "box": ("square", "object", 0.5),
    "goal": ("square", "goal", 0.95),
    "lava": ("square", "hazard", 0.95),
}
"""Shape, role and size of what a cell may hold."""

NAMED = {"door", "key", "ball", "box"}
"""What may be there several times, told apart by its colour."""
COLOURS = ("red", "green", "blue", "purple", "yellow", "grey")
STATES = ("open", "closed", "locked")
"""Of a door; both in the order of MiniGrid's numbers."""

_AJAR = 0.3
"""How strong a door looks that stands open."""


def rooms_scene(world: Any) -> Scene:  # noqa: ANN401 - gymnasium's worlds share no useful type
    """The rooms with all that is in them, and the robot, which looks where its triangle points."""
    columns, rows = world.width, world.height
    middles = {(column, row): (column + 0.5, rows - row - 0.5) for row in range(rows) for column in range(columns)}
    ground = [Mark(f"cell {cell}", "square", "ground", *middle, 0.95) for cell, middle in middles.items()]

    def marks(_: Values) -> Iterator[Mark]:
        held = world.grid.encode().tolist()
        yield from ground
        for (column, row), middle in middles.items():
            yield _thing(f"thing {(column, row)}", middle, held[column][row])
        column, row = (int(number) for number in world.agent_pos)
        turn = -world.agent_dir * pi / 2
        yield Mark("robot", "triangle", "robot", *middles[column, row], 0.7, label=_burden(world), angle=turn)

    return Scene((0.0, 0.0, float(columns), float(rows)), marks)


def _thing(name: str, middle: tuple[float, float], held: Sequence[int]) -> Mark:
    """What a cell holds; not seen where that is nothing."""
    kind, colour, state = held
    thing = OBJECTS[kind]
    if thing not in LOOKS:
        return Mark(name, "square", "ground", *middle, 0.95, shade=0.0)
    shape, role, size = LOOKS[thing]
    words = [STATES[state]] * (kind == DOOR) + [COLOURS[colour], thing]
    shade = _AJAR if kind == DOOR and state == OPEN else 1.0
    return Mark(name, shape, role, *middle, size, shade, " ".join(words) if thing in NAMED else "")


def _burden(world: Any) -> str:  # noqa: ANN401 - as above
    return f"carries {world.carrying.color} {world.carrying.type}" if world.carrying else ""
