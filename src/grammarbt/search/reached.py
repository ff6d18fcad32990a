"""Trees that differ only where no tick arrived: what one of them earns, the other earns too."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal, TypeAlias

from grammarbt.bt import BehaviorTree
from grammarbt.bt.compiler import FAILURE, RUNNING, SUCCESS, Steps, compile_steps
from grammarbt.bt.simplify import size

MOST_PLACES = 300_000
"""Places after which all is forgotten: some 20,000 trees, and 50 MB."""

ENDS = {SUCCESS: "S", FAILURE: "F", RUNNING: "R"}
NEVER = "?"
"""Stands for all that comes after an answer that a leaf never gave."""

Ahead: TypeAlias = tuple[int, "Ahead"] | None
"""Steps that are still to be read, the next one first."""

Branch: TypeAlias = tuple[int, Ahead, dict[int, str]]
"""A place in what is known, the steps ahead, and the names of those behind."""


class ReachedTrees:
    """Knows trees by the steps that ticks came to; in one and the same scenario, a simulation depends on those alone.

    Trees are read depth first, a step at a time, and readings that begin alike share their places.

    Args:
        depends_on: where a return depends on the tree itself, a smaller tree than a known one may earn more, and is not
            taken to be known; a larger one is, on the assumption that nodes which do nothing bring nothing.
    """

    def __init__(self, depends_on: Literal["behaviour", "tree"]) -> None:
        self._by_tree = depends_on == "tree"
        self._next: dict[tuple[int, str], int] = {}
        self._sizes: dict[int, int] = {}

    def add(self, tree: BehaviorTree, ticks: Sequence[int]) -> None:
        """Remember a tree, and how often its leaves were ticked."""
        if not ticks or not ticks[0]:  # who counts no ticks does not say what was reached
            return
        if len(self._next) > MOST_PLACES:
            self._next, self._sizes = {}, {}
        place = 0
        for text in _read(compile_steps(tree), ticks):
            place = self._next.setdefault((place, text), len(self._next) + 1)
        nodes = size(tree)
        self._sizes[place] = min(nodes, self._sizes.get(place, nodes))

    def knows(self, tree: BehaviorTree) -> bool:
        """Whether a known tree went exactly the ways that this one would go."""
        steps = compile_steps(tree)
        branches: list[Branch] = [(0, (steps.first, None), dict(ENDS))]
        while branches:
            known = self._sizes.get(self._follow(steps, branches))
            if known is not None and not (self._by_tree and size(tree) < known):
                return True
        return False

    def _follow(self, steps: Steps, branches: list[Branch]) -> int:
        """Read on from the last branch, to the end; where only some known trees went on, the others are another branch."""
        place, ahead, names = branches.pop()
        while ahead is not None:
            at, rest = ahead
            text = names.get(at) or _text(steps, at)
            further, never = self._next.get((place, text)), self._next.get((place, NEVER))
            if further is None:
                if never is None:
                    return -1
                further = never
            else:
                if never is not None:
                    branches.append((never, rest, dict(names)))
                rest = _opened(names, steps, at, rest)
            place, ahead = further, rest
        return place


def _read(steps: Steps, ticks: Sequence[int]) -> Iterator[str]:
    """The steps depth first: each leaf at the first visit, its number from then on."""
    names = dict(ENDS)
    ahead: Ahead = (steps.first, None)
    while ahead is not None:
        at, ahead = ahead
        if at in names or ticks[steps.steps[at][1]]:
            yield names.get(at) or _text(steps, at)
            ahead = _opened(names, steps, at, ahead)
        else:
            yield NEVER


def _text(steps: Steps, at: int) -> str:
    leaf, _, _, _, running = steps.steps[at]
    return leaf.text if running == RUNNING else f"{leaf.text}+"


def _opened(names: dict[int, str], steps: Steps, at: int, rest: Ahead) -> Ahead:
    """Name a step at the first visit; then what its answers lead to comes before the rest."""
    if at in names:
        return rest
    names[at] = str(len(names))
    _, _, success, failure, running = steps.steps[at]
    return (success, (failure, rest if running == RUNNING else (running, rest)))
