"""What a picture of a world is made of."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeAlias

from attrs import frozen

from grammarbt.domain import Mark, Role
from grammarbt_gymnasium.features import Values

Box: TypeAlias = tuple[float, float, float, float]


@frozen(eq=False)
class Scene:
    """A world that can be drawn.

    Attributes:
        box: left, bottom, right and top, in the units of the marks.
        marks: the world with these features of an observation, the same names each time.
    """

    box: Box
    marks: Callable[[Values], Iterable[Mark]]


def line(name: str, role: Role, start: tuple[float, float], end: tuple[float, float], width: float) -> Mark:
    """A line from start to end."""
    return Mark(name, "line", role, *start, width, to_x=end[0], to_y=end[1])
