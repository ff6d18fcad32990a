"""Which sub-trees do something: take each out and see what it costs, on the same scenarios."""

from __future__ import annotations

from functools import cache, cached_property
from typing import TYPE_CHECKING

from attrs import frozen

from grammarbt.bt import BehaviorTree, Fallback, Node, Parallel, Sequence, format_tree, leaves, numbered, parse, without
from grammarbt.domain import Vocabulary, actions_of, conditions_of
from grammarbt.run.score import Score, Validator, score_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from collections.abc import Set as AbstractSet

    from grammarbt.domain import Returns

_MATTERS = 0.1
"""Share of the reference's mean return that a group's removal costs at least, if the group matters."""

_WORKS = 0.5
"""Share of what a group's removal costs the reference that it costs a tree at least, if the group works in it."""


@frozen
class Ablation:
    """What a top sub-tree is worth.

    Attributes:
        subtree: in the one-line notation.
        group: the group that owns all its leaves, or None.
        drop: mean return lost when it is taken out.
        stderr: standard error of that.
        works: whether that is at least half of what the reference loses without the group, and more than chance.
    """

    subtree: str
    group: str | None
    drop: float
    stderr: float
    works: bool


@frozen
class Functional:
    """The ablations of a tree, and whether every group that matters works in it.

    A group matters when it matters to the first reference, and to every other that is at least as good.
    """

    functional: tuple[Ablation, ...]
    complete: bool | None


class Ablator:
    """Takes sub-trees out of trees and compares scenario by scenario.

    Args:
        validator: simulates on fresh scenarios.
        episodes: scenarios per tree.
    """

    def __init__(self, validator: Validator, episodes: int) -> None:
        self._returns: Callable[[BehaviorTree], Returns] = cache(lambda tree: validator.returns(tree, episodes))
        self._vocabulary = validator.domain.vocabulary
        self._references = validator.domain.references

    def ablate(self, tree: BehaviorTree) -> Functional:
        """Take out each top sub-tree, then each group."""
        ablations = tuple(self._ablation(part, self.drop(tree, {place})) for place, part in top_subtrees(tree))
        return Functional(ablations, self._complete(tree) if self._references else None)

    def drop(self, tree: BehaviorTree, gone: AbstractSet[int]) -> Score:
        """Mean return lost without the nodes at some places in pre-order, scenario by scenario."""
        whole = self._returns(tree)
        rest = without(tree, gone)
        return score_of(whole if rest is None else whole - self._returns(rest))

    def _ablation(self, part: Node, drop: Score) -> Ablation:
        group = group_of(part, self._vocabulary)
        enough = drop.mean > 2 * drop.stderr and drop.mean >= _WORKS * self._needed.get(group, 0.0)
        return Ablation(format_tree(part), group, drop.mean, drop.stderr, enough)

    def _complete(self, tree: BehaviorTree) -> bool:
        costs = self._group_costs(tree)
        lacking = [group for group, cost in self._needed.items() if costs.get(group, 0.0) < _WORKS * cost]
        return all(self._is_spared(group) for group in lacking)

    def _is_spared(self, group: str | None) -> bool:
        """Whether a reference that is at least as good as the first does without the group."""
        first, *others = (parse(reference.tree) for reference in self._references)
        good = [other for other in others if self._mean(other) >= self._mean(first)]
        return any(self._group_costs(tree).get(group, 0.0) < _MATTERS * abs(self._mean(tree)) for tree in good)

    def _mean(self, tree: BehaviorTree) -> float:
        return score_of(self._returns(tree)).mean

    @cached_property
    def _needed(self) -> Mapping[str | None, float]:
        """What each group that matters to the first reference is worth there."""
        if not self._references:
            return {}
        reference = parse(self._references[0].tree)
        least = _MATTERS * abs(self._mean(reference))
        return {group: cost for group, cost in self._group_costs(reference).items() if cost >= least}

    def _group_costs(self, tree: BehaviorTree) -> dict[str | None, float]:
        places: dict[str, set[int]] = {}
        for place, part in top_subtrees(tree):
            group = group_of(part, self._vocabulary)
            if group is not None:
                places.setdefault(group, set()).add(place)
        return {group: self.drop(tree, gone).mean for group, gone in places.items()}


def top_subtrees(tree: BehaviorTree) -> list[tuple[int, Node]]:
    """The root's children with their places in pre-order; the tree itself when its root is no control node."""
    if not isinstance(tree, Fallback | Sequence | Parallel):
        return [(0, tree)]
    return [(place, node) for place, (node, parent) in enumerate(numbered(tree)) if parent == 0]


def group_of(part: Node, vocabulary: Vocabulary) -> str | None:
    """The first group that owns all leaves of a sub-tree."""
    used = leaves(part)
    for group in vocabulary.groups:
        own = {*actions_of(group), *conditions_of(group)}
        if own.issuperset(used):
            return group.name
    return None
