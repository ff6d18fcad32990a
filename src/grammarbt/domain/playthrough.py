"""An episode as text, tick by tick: to read, and to keep beside the tests of a domain."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, Protocol

from grammarbt.bt import Action, Leaf, Status, compile_policy, format_leaf, format_tree, leaves
from grammarbt.domain.base import Domain
from grammarbt.domain.episode import Watchable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grammarbt.bt import BehaviorTree
    from grammarbt.domain.episode import Frame

__all__ = ["WatchableDomain", "playthrough"]

_STATUS = {Status.SUCCESS: "success", Status.FAILURE: "failure", Status.RUNNING: "running"}
_TRUTH = {Status.SUCCESS: "yes", Status.FAILURE: "no"}


class WatchableDomain(Domain, Watchable, Protocol):
    """A simulator whose episodes can be watched."""


def playthrough(domain: WatchableDomain, tree: BehaviorTree, scenario: int) -> str:
    """What each leaf answered in every tick, and what came of it; a line for equal ticks that follow each other.

    Args:
        domain: the simulator.
        tree: a tree over its leaves.
        scenario: the world.

    Returns:
        Lines such as `12–14  20  (mine found) yes, [disarm] running`: the ticks, the return after them, the answers,
        and after a bar the events.

    Raises:
        DomainError: the tree has a leaf that the domain does not know.
    """
    episode = domain.episode(compile_policy(tree, domain.vocabulary.index), scenario)
    texts = [_frame_text(frame, leaves(tree)) for frame in episode.frames]
    runs = (list(run) for _, run in groupby(range(len(texts)), key=texts.__getitem__))
    head = [f"tree {format_tree(tree)}", f"scenario {scenario}"]
    return "\n".join([*head, *(f"{_ticks(run)}  {texts[run[0]]}" for run in runs)]) + "\n"


def _frame_text(frame: Frame, names: Sequence[Leaf]) -> str:
    answers = ", ".join(_answer_text(names[occurrence], status) for occurrence, status in frame.answers)
    return " | ".join([f"{frame.reward:g}  {answers}", *frame.events])


def _answer_text(leaf: Leaf, status: Status) -> str:
    return f"{format_leaf(leaf)} {(_STATUS if isinstance(leaf, Action) else _TRUTH)[status]}"


def _ticks(run: Sequence[int]) -> str:
    first, last = run[0] + 1, run[-1] + 1
    return str(first) if first == last else f"{first}–{last}"
