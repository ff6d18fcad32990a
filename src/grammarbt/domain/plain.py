"""Worlds in plain Python, one leaf after the other: what compiled simulators are compared with, and watched through."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from grammarbt.bt import flatten, tick
from grammarbt.domain.episode import Drawing, Episode, Frame

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from grammarbt.bt import BehaviorTree, FlatTree, Leaf, Status
    from grammarbt.domain.episode import Mark

    TickAnswers = tuple[tuple[int, Status], ...]

__all__ = ["EpisodeOverError", "World", "play", "record"]


class EpisodeOverError(Exception):
    """Raised by `World.answer` when the episode is over in the middle of a tick; the leaf then counts as not ticked."""


class World(Protocol):
    """A world at the start of an episode, in which one tree is about to act."""

    @property
    def reward(self) -> float:
        """The return so far."""
        ...

    @property
    def done(self) -> bool:
        """Whether the episode is over."""
        ...

    def answer(self, leaf: Leaf, occurrence: int) -> Status:
        """Do one step of an action, or ask a condition.

        Raises:
            EpisodeOverError: it is over.
        """
        ...

    def step(self, status: Status | None) -> None:
        """Let the world move on after a tick, to which the tree answered so; None where the episode ended within it."""
        ...

    def picture(self) -> Sequence[Mark]:
        """The world as it is now."""
        ...

    def events(self) -> Sequence[str]:
        """What is worth stopping at since it was last asked, in words."""
        ...


def play(world: World, tree: BehaviorTree) -> Iterator[TickAnswers]:
    """Let the tree act until the episode is over; gives after each tick what its leaves answered, by occurrence."""
    flat = flatten(tree)
    while not world.done:
        answers: list[tuple[int, Status]] = []
        world.step(_tick(flat, world, answers))
        yield tuple(answers)


def record(world: World, tree: BehaviorTree, box: tuple[float, float, float, float], unit: str) -> Episode:
    """The episode with all that happens in it; `box` and `unit` are those of `Episode`."""
    marks = tuple(world.picture())
    drawing = Drawing(marks)
    frames = tuple(
        Frame(answers, float(world.reward), drawing.changes(world.picture()), tuple(world.events()))
        for answers in play(world, tree)
    )
    return Episode(frames, marks, box, unit)


def _tick(flat: FlatTree, world: World, answers: list[tuple[int, Status]]) -> Status | None:
    def answer(leaf: Leaf, occurrence: int) -> Status:
        status = world.answer(leaf, occurrence)
        answers.append((occurrence, status))
        return status

    try:
        return tick(flat, answer)
    except EpisodeOverError:
        return None
