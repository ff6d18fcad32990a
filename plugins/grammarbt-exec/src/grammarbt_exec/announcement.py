"""What a program says about itself in its first line."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, TypeVar

import cattrs
from attrs import field, frozen

from grammarbt.bt import Status, compile_policy, parse
from grammarbt.domain import ActionType, ConditionType, Group, Reference, Vocabulary
from grammarbt.errors import DomainError, GrammarBTError
from grammarbt_exec.lines import read_object

Announced = TypeVar("Announced")

_STATUS = {"success": Status.SUCCESS, "failure": Status.FAILURE, "running": Status.RUNNING}


@frozen
class AnnouncedAction:
    """An action; a plain text in the program's line is its name."""

    name: str
    help: str = ""
    parameters: Mapping[str, tuple[str, ...]] = field(factory=dict)
    results: tuple[Literal["success", "failure", "running"], ...] = ("success", "failure", "running")

    @property
    def type(self) -> ActionType:
        """As grammarbt has it."""
        results = frozenset(_STATUS[result] for result in self.results)
        return ActionType(self.name, self.help, tuple(self.parameters.items()), results)


@frozen
class AnnouncedCondition:
    """A condition; a plain text in the program's line is its name. Purity is a promise, so it must be said."""

    name: str
    help: str = ""
    parameters: Mapping[str, tuple[str, ...]] = field(factory=dict)
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
    """

    protocol: Literal[1]
    groups: tuple[AnnouncedGroup, ...]
    grammar: str = "general"
    references: tuple[Reference, ...] = ()
    depends_on: Literal["behaviour", "tree"] = "behaviour"

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
    try:
        announcement = _CONVERTER.structure(read_object(line), Announcement)
        announcement.vocabulary()
    except cattrs.BaseValidationError as error:
        raise ValueError("; ".join(cattrs.transform_error(error, "$", _told))) from None
    except GrammarBTError as error:
        raise ValueError(str(error)) from None
    return announcement


def _converter() -> cattrs.Converter:
    converter = cattrs.Converter(forbid_extra_keys=True)
    for plain in (str, bool):
        converter.register_structure_hook(plain, _unchanged)
    for leaf in (AnnouncedAction, AnnouncedCondition):
        whole = converter.get_structure_hook(leaf)
        converter.register_structure_hook(
            leaf, lambda value, kind, whole=whole: kind(value) if isinstance(value, str) else whole(value, kind)
        )
    return converter


def _unchanged(value: object, kind: type[Announced]) -> Announced:
    if not isinstance(value, kind):
        raise TypeError(value)
    return value


def _told(error: BaseException, kind: type | None) -> str:
    if isinstance(error, AttributeError):  # what cattrs trips over when it expects an object
        return "not a JSON object"
    return cattrs.v.format_exception(error, kind)


_CONVERTER = _converter()
