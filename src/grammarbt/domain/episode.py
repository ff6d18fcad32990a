"""A recorded episode: what the leaves answered at every tick, and a drawing of the world as it changes.

A domain draws with marks: a few plain shapes that carry a *role*, never a colour, so that every viewer, on screen or on
paper, light or dark, gives robots, goals and hazards a look of its own. Only what changes is recorded, which keeps a long
episode small.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Literal, Protocol, TypeAlias, runtime_checkable

from attrs import frozen

from grammarbt.bt.status import Status

if TYPE_CHECKING:
    from grammarbt.bt import Policy

Shape: TypeAlias = Literal["circle", "square", "triangle", "line", "text"]
"""What a mark is drawn as."""

Role: TypeAlias = Literal["ground", "path", "place", "robot", "goal", "hazard", "object", "belief", "note"]
"""What a mark stands for, from which every viewer chooses its colours."""


@frozen
class Mark:
    """A shape in the picture of a world.

    Attributes:
        name: tells it from the other marks of the episode; a later mark of that name takes its place.
        shape: a line goes from (x, y) to (to_x, to_y); text stands at (x, y).
        role: what it stands for, which decides how it looks.
        x: centre, in the world's units, to the right.
        y: centre, in the world's units, upwards.
        size: diameter, side or line width, in the world's units; height of the letters for text.
        shade: how strong it is, from 0 (not seen) to 1; a belief's probability, for one.
        label: a word shown beside it; the text itself for text.
        to_x: end of a line.
        to_y: end of a line.
        angle: radians to the left by which it is turned; a triangle of angle 0 points to the right.
    """

    name: str
    shape: Shape
    role: Role
    x: float
    y: float
    size: float
    shade: float = 1.0
    label: str = ""
    to_x: float = 0.0
    to_y: float = 0.0
    angle: float = 0.0


@frozen
class Frame:
    """What one tick did.

    Attributes:
        answers: the leaves ticked, in order, each as its occurrence in the tree and what it answered.
        reward: the return so far, after the tick.
        changes: the marks that are new or differ from the frame before.
        events: what is worth stopping at, in words: "mine disarmed".
    """

    answers: tuple[tuple[int, Status], ...]
    reward: float
    changes: tuple[Mark, ...] = ()
    events: tuple[str, ...] = ()


@frozen
class Episode:
    """One episode from start to end.

    Attributes:
        frames: one per tick.
        marks: the world before the first tick, drawn in this order.
        box: left, bottom, right and top of what is to be seen, in the world's units.
        unit: what the reward counts, for the viewer's caption.
    """

    frames: tuple[Frame, ...]
    marks: tuple[Mark, ...] = ()
    box: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0)
    unit: str = ""

    def pictures(self) -> Iterator[Mapping[str, Mark]]:
        """The marks by name, in the order in which they are drawn: before the first tick, then after each."""
        marks = {mark.name: mark for mark in self.marks}
        yield dict(marks)
        for frame in self.frames:
            marks.update((mark.name, mark) for mark in frame.changes)
            yield dict(marks)


@runtime_checkable
class Watchable(Protocol):
    """A domain whose episodes can be watched."""

    def episode(self, policy: Policy, scenario: int) -> Episode:
        """The episode that `simulate` scores: its last frame's reward is the return of that scenario."""
        ...


class Drawing:
    """Keeps the marks of a world and tells which of them changed."""

    def __init__(self, marks: Iterable[Mark] = ()) -> None:
        self._marks = {mark.name: mark for mark in marks}

    def changes(self, marks: Iterable[Mark]) -> tuple[Mark, ...]:
        """Those of the marks that are new or different, which are then known."""
        changed = tuple(mark for mark in marks if self._marks.get(mark.name) != mark)
        self._marks.update((mark.name, mark) for mark in changed)
        return changed
