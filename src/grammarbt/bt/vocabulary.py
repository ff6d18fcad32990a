"""What a robot can do and ask: groups of leaves."""

from __future__ import annotations

from functools import cached_property
from itertools import product

from attrs import field, frozen

from grammarbt.bt.model import Action, Condition, Leaf
from grammarbt.bt.status import Status
from grammarbt.errors import DomainError

ANY_RESULT = frozenset({Status.SUCCESS, Status.FAILURE, Status.RUNNING})


@frozen
class LeafType:
    """A kind of leaf, in one sentence.

    Attributes:
        name: as it stands in trees.
        help: one sentence for people.
        parameters: for leaves with arguments, each parameter's finite set of values.
    """

    name: str
    help: str = ""
    parameters: tuple[tuple[str, tuple[str, ...]], ...] = ()

    def arguments(self) -> tuple[tuple[tuple[str, str], ...], ...]:
        """Every combination of argument values, in the order declared."""
        keys = [key for key, _ in self.parameters]
        return tuple(tuple(zip(keys, values, strict=True)) for values in product(*(v for _, v in self.parameters)))


@frozen
class ActionType(LeafType):
    """An action; `results` are the answers it may give (all three unless declared)."""

    results: frozenset[Status] = ANY_RESULT


@frozen
class ConditionType(LeafType):
    """A condition; a *pure* one draws no randomness and changes only when an action runs."""

    pure: bool = True


@frozen
class Group:
    """Leaves that belong together (the paper's g = [A_g, C_g])."""

    name: str
    actions: tuple[ActionType, ...] = ()
    conditions: tuple[ConditionType, ...] = ()


def _distinct_groups(_: object, __: object, groups: tuple[Group, ...]) -> None:
    names = [group.name for group in groups]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise DomainError(f"two groups of the vocabulary are called {twice[0]!r}", "rename one")


@frozen(slots=False)  # slots=False: cached_property keeps its value in the instance's dict
class Vocabulary:
    """A domain's leaves, in groups; a leaf may belong to several groups."""

    groups: tuple[Group, ...] = field(validator=_distinct_groups)

    @cached_property
    def leaves(self) -> tuple[Leaf, ...]:
        """Every leaf once, in the order declared, actions of a group before its conditions."""
        found: list[Leaf] = []
        for group in self.groups:
            found += [*actions_of(group), *conditions_of(group)]
        return tuple(dict.fromkeys(found))

    @cached_property
    def index(self) -> dict[Leaf, int]:
        """Each leaf's number."""
        return {leaf: number for number, leaf in enumerate(self.leaves)}

    @cached_property
    def types(self) -> dict[Leaf, ActionType | ConditionType]:
        """What was declared about each leaf."""
        found: dict[Leaf, ActionType | ConditionType] = {}
        for group in self.groups:
            for action in group.actions:
                found.update((leaf, action) for leaf in _actions(action))
            for condition in group.conditions:
                found.update((leaf, condition) for leaf in _conditions(condition))
        return found

    @cached_property
    def results(self) -> dict[Leaf, frozenset[Status]]:
        """The answers that each action may give, as declared."""
        return {leaf: kind.results for leaf, kind in self.types.items() if isinstance(kind, ActionType)}

    @cached_property
    def pure(self) -> frozenset[Leaf]:
        """The conditions that are declared to draw no randomness and to change only when an action runs."""
        return frozenset(leaf for leaf, kind in self.types.items() if isinstance(kind, ConditionType) and kind.pure)

    def is_pure(self, condition: Condition) -> bool:
        """Whether a condition is among the `pure` ones."""
        return condition in self.pure


def actions_of(group: Group) -> tuple[Action, ...]:
    """The group's actions, one for every combination of arguments."""
    return tuple(leaf for kind in group.actions for leaf in _actions(kind))


def conditions_of(group: Group) -> tuple[Condition, ...]:
    """The group's conditions, one for every combination of arguments."""
    return tuple(leaf for kind in group.conditions for leaf in _conditions(kind))


def _actions(kind: ActionType) -> tuple[Action, ...]:
    return tuple(Action(kind.name, arguments) for arguments in kind.arguments())


def _conditions(kind: ConditionType) -> tuple[Condition, ...]:
    return tuple(Condition(kind.name, arguments) for arguments in kind.arguments())
