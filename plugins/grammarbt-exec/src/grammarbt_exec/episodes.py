"""Episodes that a program tells tick by tick; believed only where they keep to the tree, and can be drawn."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from typing import TYPE_CHECKING, TypeAlias

from attrs import evolve

from grammarbt.bt import Condition, Policy, Status, format_leaf, leaves
from grammarbt.domain import Drawing, Episode, Mark
from grammarbt_exec.messages import Answer, Request
from grammarbt_exec.structure import refuse, structured

if TYPE_CHECKING:
    from grammarbt.domain import Vocabulary

Box: TypeAlias = tuple[float, float, float, float]

_FARTHEST = 1_000
"""Of what is drawn, in sides of the box around it: pictures cannot hold what is very far away."""

_FINEST = 1e-6
"""A side of the box, in its largest number: below, places in it could not be told apart."""

_ANSWERS = frozenset({Status.SUCCESS, Status.FAILURE})
"""Of a condition."""


def showing(policy: Policy, scenario: int) -> Request:
    """Asks what happens in one scenario."""
    return Request(policy, {"episode": scenario})


def episode_of(answer: Answer, policy: Policy, vocabulary: Vocabulary) -> Episode:
    """The episode in the answer; of a frame's marks those that did change.

    Raises:
        ValueError: it cannot be one; the text says why, and where in the line.
    """
    told = structured(answer, Episode)
    if not told.frames:
        refuse("an episode has at least one tick", "$.frames")
    _check_box(told.box)
    _check_marks(told.marks, told.box, "$.marks")
    walk = _Walk(policy, vocabulary)
    for number, frame in enumerate(told.frames):
        walk.check(frame.answers, f"$.frames[{number}].answers")
        _check_marks(frame.changes, told.box, f"$.frames[{number}].changes")
    drawing = Drawing(told.marks)
    return evolve(told, frames=tuple(evolve(each, changes=drawing.changes(each.changes)) for each in told.frames))


class _Walk:
    """A tick as the table prescribes it."""

    def __init__(self, policy: Policy, vocabulary: Vocabulary) -> None:
        self._names = [format_leaf(leaf) for leaf in leaves(policy.tree)]
        self._may = [
            _ANSWERS if isinstance(leaf, Condition) else vocabulary.results[leaf] for leaf in leaves(policy.tree)
        ]
        self._occurrences = policy.occurrence.tolist()
        columns = zip(*(row.tolist() for row in (policy.on_failure, policy.on_success, policy.on_running)), strict=True)
        self._next = list(columns)  # in the order of the statuses' numbers

    def check(self, answers: Sequence[tuple[int, Status]], where: str) -> None:
        """Every leaf that was ticked is the one whose turn it was, and the last one ended the tick."""
        at = 0
        for place, (occurrence, status) in enumerate(answers):
            if at < 0:
                refuse("the tick had ended before", f"{where}[{place}]")
            expected = self._occurrences[at]
            if occurrence != expected:
                refuse(f"leaf {occurrence} instead of {expected}, {self._names[expected]}", f"{where}[{place}]")
            if status not in self._may[expected]:
                refuse(f"{self._names[expected]} cannot answer {status.name.lower()}", f"{where}[{place}]")
            at = self._next[at][status]
        if at >= 0:
            expected = self._occurrences[at]
            refuse(f"the tick goes on with leaf {expected}, {self._names[expected]}", where)


def _check_box(box: Box) -> None:
    sides = box[2] - box[0], box[3] - box[1]
    if not _FINEST * max(map(abs, box)) < min(sides) <= max(sides) < inf:
        refuse("not left, bottom, right and top of a box, or too thin or large a one", "$.box")


def _check_marks(marks: Sequence[Mark], box: Box, where: str) -> None:
    names: set[str] = set()
    for place, mark in enumerate(marks):
        if mark.name in names:
            refuse(f"a second mark {mark.name!r}", f"{where}[{place}].name")
        names.add(mark.name)
        _check_mark(mark, box, f"{where}[{place}]")


def _check_mark(mark: Mark, box: Box, where: str) -> None:
    left, bottom, right, top = box
    far = _FARTHEST * max(right - left, top - bottom)
    places = {"x": mark.x - left, "y": mark.y - bottom, "to_x": mark.to_x - left, "to_y": mark.to_y - bottom}
    for key, distance in places.items():
        if abs(distance) > far:
            refuse(f"more than {_FARTHEST:,} times the box away from it", f"{where}.{key}")
    if not 0 <= mark.size <= far:
        refuse(f"not from 0 to {_FARTHEST:,} times the box", f"{where}.size")
    if not 0 <= mark.shade <= 1:
        refuse("not from 0 to 1", f"{where}.shade")
