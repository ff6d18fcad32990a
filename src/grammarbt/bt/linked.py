"""Ticking where a world's answers can be looked up by number: the flat policy as steps that point at each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from grammarbt.bt.compiler import FAILURE, RUNNING, SUCCESS
from grammarbt.bt.status import Status

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.bt.policy import FlatTree


class Answers(Protocol):
    """What leaves answer, looked up when a leaf is ticked: a list, or an object whose look-up acts on the world."""

    def __getitem__(self, occurrence: int, /) -> int:
        """A `Status`, or its number."""
        ...


Ticker: TypeAlias = "Callable[[Answers], Status]"
"""Ticks a tree once, looking up what its leaves answer, and gives the root's status."""

_Step: TypeAlias = tuple[int | None, Any]
"""A leaf's occurrence and the steps that follow failure, success and running; at the end None and the tick's status."""

_ENDS: dict[int, _Step] = {
    SUCCESS: (None, Status.SUCCESS),
    FAILURE: (None, Status.FAILURE),
    RUNNING: (None, Status.RUNNING),
}


def ticker(flat: FlatTree) -> Ticker:
    """A function that ticks the tree once and gives the root's status; it calls nothing but the look-up."""
    first_leaf, first_after = _linked(flat)

    def tick(answers: Answers) -> Status:
        leaf, after = first_leaf, first_after
        while leaf is not None:
            leaf, after = after[answers[leaf]]
        status: Status = after
        return status

    return tick


def _linked(flat: FlatTree) -> _Step:
    """The first step; a step comes after all that it leads to, since ticks go from left to right."""
    steps = dict(_ENDS)
    for at in sorted(range(len(flat.entries)), key=lambda at: -flat.entries[at].occurrence):
        entry = flat.entries[at]
        following = (steps[entry.on_failure], steps[entry.on_success], steps[entry.on_running])
        steps[at] = (entry.occurrence, following)
    return steps[flat.entry]
