"""An episode as compact data: what every node answered at every tick, and what changed in the picture."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from attrs import fields, frozen

from grammarbt.bt import BehaviorTree, Status, format_leaf, leaves, node_statuses
from grammarbt.domain import FIRST_VALIDATION_SCENARIO as FIRST
from grammarbt.domain import Episode, Mark, Watchable, scenario_numbers
from grammarbt.errors import DomainError, GrammarBTError

if TYPE_CHECKING:
    from grammarbt.bt import Policy
    from grammarbt.domain import Domain

Statuses: TypeAlias = tuple[Status | None, ...]

LETTERS: dict[Status | None, str] = {Status.SUCCESS: "S", Status.FAILURE: "F", Status.RUNNING: "R", None: "."}
"""What a node answered, as a letter; a point for a node that was not ticked."""

_DIGITS = 4
"""Decimals that are kept of a place in the world and of a reward."""

_DEFAULTS = {attribute.name: attribute.default for attribute in fields(Mark)}


def watch(domain: Domain, name: str, policy: Policy, seed: int, number: int) -> Episode:
    """The episode of a tree in the fresh world of that number, counted from 0.

    Raises:
        DomainError: the domain cannot be watched, or its simulator fails.
    """
    if not isinstance(domain, Watchable):
        hint = "give it a method `episode`, as TickDomain has; a program of exec answers episodes if it announces so"
        raise DomainError(f"domain {name!r} cannot show an episode", hint)
    (scenario,) = scenario_numbers(seed, FIRST + number, FIRST + number + 1)
    try:
        return domain.episode(policy, int(scenario))
    except GrammarBTError:
        raise
    except Exception as error:  # a simulator is foreign code: whatever it raises is the user's to hear
        raise DomainError(
            f"domain {name!r} cannot show the episode: {type(error).__name__}: {error}", "--traceback shows where"
        ) from error


@frozen
class Stop:
    """A tick worth stopping at, counted from 1, and why."""

    tick: int
    text: str


def statuses_of(tree: BehaviorTree, episode: Episode) -> list[Statuses]:
    """What every node answered, tick by tick; each in pre-order."""
    known: dict[tuple[tuple[int, Status], ...], Statuses] = {}
    return [
        known.get(frame.answers) or known.setdefault(frame.answers, node_statuses(tree, dict(frame.answers)))
        for frame in episode.frames
    ]


def stops_of(tree: BehaviorTree, episode: Episode) -> list[Stop]:
    """The domain's events; when it tells of none, the ticks in which another leaf decides."""
    told = [Stop(tick, text) for tick, frame in enumerate(episode.frames, 1) for text in frame.events]
    return told or list(_decisions(tree, episode))


def recording(tree: BehaviorTree, episode: Episode) -> dict[str, Any]:
    """What the page's script reads.

    Each frame is the number of its line of `statuses`, the reward, and the changes: a mark's number, and what is new of
    it. Marks are numbered in the order in which they appear, the first ones in `marks`.
    """
    lines = ["".join(LETTERS[status] for status in statuses) for statuses in statuses_of(tree, episode)]
    distinct = {line: number for number, line in enumerate(dict.fromkeys(lines))}
    world = _World()
    return {
        "box": list(episode.box),
        "unit": episode.unit,
        "marks": [world.change(mark)[1] for mark in episode.marks],
        "statuses": list(distinct),
        "frames": [
            [distinct[line], round(frame.reward, _DIGITS), [world.change(mark) for mark in frame.changes]]
            for line, frame in zip(lines, episode.frames, strict=True)
        ],
        "stops": [[stop.tick, stop.text] for stop in stops_of(tree, episode)],
    }


class _World:
    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}
        self._marks: dict[str, dict[str, Any]] = {}

    def change(self, mark: Mark) -> tuple[int, dict[str, Any]]:
        """The mark's number, and its fields that are not what they were."""
        before, after = self._marks.get(mark.name, _DEFAULTS), _plain(mark)
        self._marks[mark.name] = after
        number = self._numbers.setdefault(mark.name, len(self._numbers))
        return number, {key: value for key, value in after.items() if before[key] != value}


def _plain(mark: Mark) -> dict[str, Any]:
    names = (attribute.name for attribute in fields(Mark) if attribute.name != "name")
    values = {name: getattr(mark, name) for name in names}
    return {key: round(float(value), _DIGITS) if not isinstance(value, str) else value for key, value in values.items()}


def _decisions(tree: BehaviorTree, episode: Episode) -> Iterator[Stop]:
    names, before = [format_leaf(leaf) for leaf in leaves(tree)], -1
    for tick, frame in enumerate(episode.frames, 1):
        last = frame.answers[-1][0] if frame.answers else -1
        if last not in (before, -1):
            yield Stop(tick, names[last])
        before = last
