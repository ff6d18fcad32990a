"""The compiled simulator and the one in plain Python agree on every number."""

from itertools import chain
from typing import get_args

import numpy as np
import pytest

from grammarbt.bt import Action, Condition, Fallback, Node, Not, Sequence, Status, compile_policy, leaves, parse, walk
from grammarbt.domain.plain import play
from grammarbt.testing import tally, wild_tree
from grammarbt_pickplace.domain import PickPlace
from grammarbt_pickplace.parameters import PickPlaceParameters
from grammarbt_pickplace.plain import PlainPickPlace
from grammarbt_pickplace.tasks import TASKS

EPISODES = 20
SEEDS = range(25)


def mutant(rng, task):
    """A reference tree with a few of its leaves replaced or wrapped: it gets further than a wild tree."""
    tree = parse(task.references[rng.integers(len(task.references))].tree)
    chosen = {int(at) for at in rng.integers(len(leaves(tree)), size=2)}
    count = iter(range(len(leaves(tree))))

    def changed(node):
        if isinstance(node, Action | Condition):
            if next(count) not in chosen:
                return node
            return Fallback((node, wild_tree(rng, task.vocabulary.leaves, 3)))
        return Not(changed(node.child)) if isinstance(node, Not) else type(node)(tuple(map(changed, node.children)))

    return changed(tree)


def watched(tree, task):
    """The tree with every condition asked in every tick."""
    conditions = (leaf for leaf in task.vocabulary.leaves if isinstance(leaf, Condition))
    return Sequence((*(Fallback((condition, Not(condition))) for condition in conditions), tree))


def trees(task):
    rngs = [np.random.default_rng(seed) for seed in SEEDS]
    return [
        *(parse(reference.tree) for reference in task.references),
        *(watched(parse(reference.tree), task) for reference in task.references),
        *(mutant(rng, task) for rng in rngs),
        *(wild_tree(rng, task.vocabulary.leaves, 24) for rng in rngs),
    ]


@pytest.mark.parametrize("stochastic", [False, True], ids=["certain", "stochastic"])
@pytest.mark.parametrize("name", list(TASKS))
def test_returns_and_ticks_are_equal_on_every_episode(name, stochastic):
    domain = PickPlace(PickPlaceParameters(name, stochastic))
    scenarios = np.arange(EPISODES) + 2**32 * 7
    for tree in trees(TASKS[name]):
        outcome = domain.simulate(compile_policy(tree, domain.vocabulary.index), scenarios)
        worlds = [PlainPickPlace(TASKS[name], tree, int(number), stochastic=stochastic) for number in scenarios]
        returns, ticks = zip(*(tally(world, tree) for world in worlds), strict=True)
        assert outcome.returns.tolist() == [*returns]
        assert outcome.ticks.tolist() == np.sum(ticks, axis=0).tolist()


def test_the_trees_compared_have_every_kind_of_node_and_every_leaf():
    for task in TASKS.values():
        nodes = [node for tree in trees(task) for node in walk(tree)]
        assert {type(node) for node in nodes} == {*get_args(Node)}
        assert {node for node in nodes if isinstance(node, Action | Condition)} == set(task.vocabulary.leaves)


def test_every_leaf_answers_all_that_the_vocabulary_declares_and_nothing_else():
    task = TASKS["S3"]
    answers = {leaf: set() for leaf in task.vocabulary.leaves}
    for tree in trees(task):
        row = leaves(tree)
        for scenario in range(EPISODES):
            world = PlainPickPlace(task, tree, scenario, stochastic=True)
            for occurrence, status in chain.from_iterable(play(world, tree)):
                answers[row[occurrence]].add(status)
    for leaf, kind in task.vocabulary.types.items():
        assert answers[leaf] == (kind.results if isinstance(leaf, Action) else {Status.SUCCESS, Status.FAILURE}), leaf
