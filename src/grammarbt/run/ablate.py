"""Which sub-trees do something: take each out and see what it costs, on the same scenarios."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from attrs import evolve, frozen

from grammarbt.bt import BehaviorTree, Fallback, Node, Parallel, Sequence, format_tree, leaves, parse
from grammarbt.domain import Vocabulary, actions_of, conditions_of
from grammarbt.run.score import Score, Validator, score_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

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
    """The ablations of a tree, and whether every group that matters to the reference works in it."""

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
        references = validator.domain.references
        self._needed = self._reference_costs(parse(references[0].tree)) if references else {}
        self._has_reference = bool(references)

    def ablate(self, tree: BehaviorTree) -> Functional:
        """Take out each top sub-tree, then each group."""
        ablations = tuple(self._ablation(part, self._drop(tree, _is(part))) for part in top_subtrees(tree))
        return Functional(ablations, self._complete(tree) if self._has_reference else None)

    def _ablation(self, part: Node, drop: Score) -> Ablation:
        group = group_of(part, self._vocabulary)
        enough = drop.mean > 2 * drop.stderr and drop.mean >= _WORKS * self._needed.get(group, 0.0)
        return Ablation(format_tree(part), group, drop.mean, drop.stderr, enough)

    def _complete(self, tree: BehaviorTree) -> bool:
        costs = self._group_costs(tree)
        return all(costs.get(group, 0.0) >= _WORKS * cost for group, cost in self._needed.items())

    def _reference_costs(self, reference: BehaviorTree) -> Mapping[str | None, float]:
        """What each group that matters to the reference is worth there."""
        least = _MATTERS * abs(score_of(self._returns(reference)).mean)
        return {group: cost for group, cost in self._group_costs(reference).items() if cost >= least}

    def _group_costs(self, tree: BehaviorTree) -> dict[str | None, float]:
        present = dict.fromkeys(group_of(part, self._vocabulary) for part in top_subtrees(tree))
        return {group: self._drop(tree, self._belongs_to(group)).mean for group in present if group is not None}

    def _belongs_to(self, group: str) -> Callable[[Node], bool]:
        return lambda part: group_of(part, self._vocabulary) == group

    def _drop(self, tree: BehaviorTree, goes: Callable[[Node], bool]) -> Score:
        whole = self._returns(tree)
        rest = without(tree, goes)
        return score_of(whole if rest is None else whole - self._returns(rest))


def top_subtrees(tree: BehaviorTree) -> tuple[Node, ...]:
    """The root's children; the tree itself when its root is no control node."""
    return tree.children if isinstance(tree, Fallback | Sequence | Parallel) else (tree,)


def _is(one: Node) -> Callable[[Node], bool]:
    # the same node, not an equal one: a tree may hold two equal sub-trees
    return lambda part: part is one


def without(tree: BehaviorTree, goes: Callable[[Node], bool]) -> BehaviorTree | None:
    """The tree without the top sub-trees that go; None when nothing is left."""
    left = tuple(part for part in top_subtrees(tree) if not goes(part))
    if not left:
        return None
    if isinstance(tree, Parallel):
        return Parallel(left, min(tree.successes, len(left)))
    return evolve(tree, children=left) if isinstance(tree, Fallback | Sequence) else tree


def group_of(part: Node, vocabulary: Vocabulary) -> str | None:
    """The first group that owns all leaves of a sub-tree."""
    used = leaves(part)
    for group in vocabulary.groups:
        own = {*actions_of(group), *conditions_of(group)}
        if own.issuperset(used):
            return group.name
    return None
