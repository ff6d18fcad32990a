"""Random trees of all kinds, and how often a world in plain Python ticks their leaves."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence as Several
from typing import TYPE_CHECKING

import numpy as np

from grammarbt.bt import Action, BehaviorTree, Condition, Fallback, Leaf, Not, Parallel, Sequence, leaves
from grammarbt.domain.plain import World, play

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

_NEGATED, _PARALLEL, _ACTIONS = 0.15, 0.15, 2 / 3
_MOST_CHILDREN = 4


def wild_tree(rng: np.random.Generator, vocabulary: Several[Leaf], size: int) -> BehaviorTree:
    """Any nesting of all kinds of nodes, sensible or not; two of three leaves are actions.

    Args:
        rng: chooses.
        vocabulary: leaves to choose from, with an action and a condition among them.
        size: a larger one makes a larger tree; 1 makes a leaf.
    """
    if size <= 1:
        kind = Action if rng.random() < _ACTIONS else Condition
        row = [leaf for leaf in vocabulary if isinstance(leaf, kind)]
        return row[rng.integers(len(row))]
    if rng.random() < _NEGATED:
        return Not(wild_tree(rng, vocabulary, size - 1))
    sizes = (int(rng.integers(1, max(2, size // 2))) for _ in range(rng.integers(2, _MOST_CHILDREN, endpoint=True)))
    parts = tuple(wild_tree(rng, vocabulary, part) for part in sizes)
    if rng.random() < _PARALLEL:
        return Parallel(parts, int(rng.integers(1, len(parts), endpoint=True)))
    return Fallback(parts) if rng.random() < 1 / 2 else Sequence(parts)


def trees_over(leaves: SearchStrategy[Leaf], most: int = 12) -> SearchStrategy[BehaviorTree]:
    """Any nesting of all kinds of nodes over some leaves, at most so many, as a strategy of Hypothesis."""
    from hypothesis import strategies as st  # noqa: PLC0415 - only tests that ask for it need Hypothesis

    def grow(inner: SearchStrategy[BehaviorTree]) -> SearchStrategy[BehaviorTree]:
        some = st.lists(inner, min_size=1, max_size=4).map(tuple)
        parallel = some.flatmap(lambda parts: st.builds(Parallel, st.just(parts), st.integers(1, len(parts))))
        return st.builds(Fallback, some) | st.builds(Sequence, some) | st.builds(Not, inner) | parallel

    return st.recursive(leaves, grow, max_leaves=most)


def tally(world: World, tree: BehaviorTree) -> tuple[float, list[int]]:
    """The return of an episode in plain Python, and how often each leaf was ticked, left to right."""
    counts = Counter(occurrence for answers in play(world, tree) for occurrence, _ in answers)
    return world.reward, [counts[occurrence] for occurrence in range(len(leaves(tree)))]
