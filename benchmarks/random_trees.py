"""Random trees for the commands of this folder."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.bt import Action, BehaviorTree, Condition, Fallback, Leaf, Node, Not, Parallel, Sequence

if TYPE_CHECKING:
    import numpy as np

NAMES = ("go to comms", "report", "a.b/c:d", "<x> & 'y' \"z\"", "été 搬运", "$v #1 %s", "-->", "Sequence")
"""Few names, so that leaves repeat, and most of them awkward."""

NEGATED, PARALLEL = 0.2, 0.3
"""Shares of negated nodes, and of parallel nodes where there are any."""


def paper_shaped(rng: np.random.Generator, subtrees: int) -> BehaviorTree:
    """A fallback of sub-trees as in Table I of the paper: each a sequence that ends, or goes on, with actions."""
    return Fallback(tuple(_subtree(rng) for _ in range(subtrees)))


def arbitrary(rng: np.random.Generator, leaves: int, *, parallel: bool) -> BehaviorTree:
    """Any tree with so many leaves."""
    if leaves == 1:
        leaf = _leaf(rng, str(rng.choice(NAMES)))
        return Not(leaf) if rng.random() < NEGATED else leaf
    first = int(rng.integers(1, leaves))
    parts = [arbitrary(rng, first, parallel=parallel), arbitrary(rng, leaves - first, parallel=parallel)]
    return _control(rng, parts, parallel=parallel)


def flattened(tree: BehaviorTree) -> BehaviorTree:
    """The tree with control nodes of one kind joined, so that nodes have more than two children."""
    if isinstance(tree, Not):
        return Not(flattened(tree.child))
    if isinstance(tree, Action | Condition):
        return tree
    parts = [flattened(child) for child in tree.children]
    if isinstance(tree, Parallel):
        return Parallel(tuple(parts), tree.successes)
    joined = [inner for part in parts for inner in (part.children if type(part) is type(tree) else (part,))]
    return type(tree)(tuple(joined))


def _subtree(rng: np.random.Generator) -> Node:
    names = [str(name) for name in rng.permutation(NAMES)]
    checks: list[Node] = [Condition(name) for name in names[: rng.integers(1, 4)]]
    checks = [Not(check) if rng.random() < NEGATED else check for check in checks]
    actions = [Action(name) for name in names[4 : 5 + rng.integers(0, 3)]]
    guarded = Fallback((Condition(names[3]), actions[0]))
    return Sequence((*checks, guarded, *actions[1:]))


def _leaf(rng: np.random.Generator, name: str) -> Leaf:
    return Action(name) if rng.integers(2) else Condition(name)


def _control(rng: np.random.Generator, parts: list[Node], *, parallel: bool) -> Node:
    if parallel and rng.random() < PARALLEL:
        return Parallel(tuple(parts), int(rng.integers(1, len(parts) + 1)))
    node = Fallback(tuple(parts)) if rng.integers(2) else Sequence(tuple(parts))
    return Not(node) if rng.random() < NEGATED else node
