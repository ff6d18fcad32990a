"""What a program says about itself in its first line."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, Literal

from attrs import field, frozen

from grammarbt.bt import Status, compile_policy, parse
from grammarbt.domain import ActionType, ConditionType, Group, Reference, Vocabulary
from grammarbt.errors import DomainError, GrammarBTError
from grammarbt_exec.lines import read_object
from grammarbt_exec.structure import structured


@frozen
class AnnouncedLeaf:
    """What actions and conditions have in common; a plain text in the program's line is a leaf's name."""

    plain: ClassVar[bool] = True

    name: str
    help: str = ""
    parameters: Mapping[str, tuple[str, ...]] = field(factory=dict)


@frozen
class AnnouncedAction(AnnouncedLeaf):
    """An action, and what it may answer."""

    results: tuple[Status, ...] = tuple(Status)

    @property
    def type(self) -> ActionType:
        """As grammarbt has it."""
        return ActionType(self.name, self.help, tuple(self.parameters.items()), frozenset(self.results))


@frozen
class AnnouncedCondition(AnnouncedLeaf):
    """A condition. Purity is a promise, so it must be said."""

    pure: bool = False

    @property
    def type(self) -> ConditionType:
        """As grammarbt has it."""
        return ConditionType(self.name, self.help, tuple(self.parameters.items()), self.pure)


@frozen
class AnnouncedGroup:
    """A group of leaves."""

    name: str
    actions: tuple[AnnouncedAction, ...] = ()
    conditions: tuple[AnnouncedCondition, ...] = ()


@frozen
class Announcement:
    """A program's first line.

    Attributes:
        protocol: the number of the protocol it speaks.
        groups: its leaves.
        grammar: the default grammar: a name, or the text itself.
        references: trees to compare with.
        depends_on: as `Domain.depends_on`.
        episodes: whether it can tell what happens in an episode, tick by tick.
    """

    protocol: Literal[1]
    groups: tuple[AnnouncedGroup, ...]
    grammar: str = "general"
    references: tuple[Reference, ...] = ()
    depends_on: Literal["behaviour", "tree"] = "behaviour"
    episodes: bool = False

    def vocabulary(self) -> Vocabulary:
        """The leaves, numbered in the order announced.

        Raises:
            GrammarBTError: there are none, a name cannot be one, or a reference tree has others.
        """
        vocabulary = Vocabulary(
            tuple(
                Group(group.name, tuple(a.type for a in group.actions), tuple(c.type for c in group.conditions))
                for group in self.groups
            )
        )
        if not vocabulary.leaves:
            raise DomainError("it has no leaves")
        for reference in self.references:
            compile_policy(parse(reference.tree), vocabulary.index)
        return vocabulary


def read_announcement(line: bytes) -> Announcement:
    """The announcement that a line holds.

    Raises:
        ValueError: it holds none; the text says what is wrong and where in it.
    """
    announcement = structured(read_object(line), Announcement)
    try:
        announcement.vocabulary()
    except GrammarBTError as error:
        raise ValueError(str(error)) from None
    return announcement
