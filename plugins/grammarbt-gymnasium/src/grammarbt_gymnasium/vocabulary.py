"""The leaves: the environment's actions and what can be asked about an observation, and how they are answered."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

from attrs import frozen

from grammarbt.bt import Action, Condition, Leaf, Status
from grammarbt.domain import ActionType, Group, Vocabulary
from grammarbt_gymnasium.conditions import Comparison, Question

if TYPE_CHECKING:
    from grammarbt_gymnasium.features import Values

Meaning: TypeAlias = tuple[Comparison | None, int, float]
"""Of a condition: the comparison, the feature's place and what it is compared with; of an action: None, its number, 0."""

RUNNING = frozenset({Status.RUNNING})


@frozen(eq=False)
class Leaves:
    """A vocabulary, and the meaning of its leaves."""

    vocabulary: Vocabulary
    meanings: Mapping[Leaf, Meaning]


def make_leaves(actions: Sequence[str], first: int, questions: Sequence[Question]) -> Leaves:
    """One group per action, each with all conditions, so that a grammar can give every action rules of its own.

    Args:
        actions: their names.
        first: the number of the first.
        questions: the conditions.
    """
    conditions = tuple(question.type for question in questions)
    groups = tuple(
        Group(name, (ActionType(name, f"Choose {name} in this step.", results=RUNNING),), conditions)
        for name in actions
    )
    meanings: dict[Leaf, Meaning] = {Action(name): (None, first + at, 0.0) for at, name in enumerate(actions)}
    for question in questions:
        for arguments, operand in zip(question.type.arguments(), question.operands, strict=True):
            meanings[Condition(question.type.name, arguments)] = (question.compare, question.feature, operand)
    return Leaves(Vocabulary(groups), meanings)


class Answers:
    """Answers the leaves of one tree by their occurrence, for the state seen last.

    Attributes:
        values: the features of the present observation.
        chosen: the action that the last leaf of an action chose.
        ticks: how often each leaf was ticked.
    """

    def __init__(self, meanings: Sequence[Meaning]) -> None:
        self._meanings = meanings
        self.ticks = [0] * len(meanings)
        self.values: Values = ()
        self.chosen = 0

    def __getitem__(self, occurrence: int) -> int:
        """A `Status`, as its number; true is success."""
        self.ticks[occurrence] += 1
        compare, place, operand = self._meanings[occurrence]
        if compare is not None:
            return compare(self.values[place], operand)
        self.chosen = place
        return Status.RUNNING


class RecordedAnswers(Answers):
    """Answers that are written down."""

    def __init__(self, meanings: Sequence[Meaning]) -> None:
        super().__init__(meanings)
        self._given: list[tuple[int, Status]] = []

    def __getitem__(self, occurrence: int) -> int:
        """A `Status`, as its number."""
        answer = super().__getitem__(occurrence)
        self._given.append((occurrence, Status(answer)))
        return answer

    def taken(self) -> tuple[tuple[int, Status], ...]:
        """Occurrence and answer of each leaf ticked since this was last asked."""
        given, self._given = tuple(self._given), []
        return given
