"""The compiled simulator and the one in plain Python agree on every number."""

from collections import Counter
from itertools import chain

import numpy as np
import pytest

from grammarbt.bt import (
    Action,
    Condition,
    Fallback,
    Not,
    Parallel,
    Sequence,
    Status,
    compile_policy,
    leaves,
    parse,
    walk,
)
from grammarbt.domain.plain import play
from grammarbt_pickplace.domain import PickPlace
from grammarbt_pickplace.parameters import PickPlaceParameters
from grammarbt_pickplace.plain import PlainPickPlace
from grammarbt_pickplace.tasks import TASKS

EPISODES = 20
SEEDS = range(25)


def pick(rng, options):
    return options[rng.integers(len(options))]


def wild_tree(rng, vocabulary, size):
    """Any nesting of all kinds of nodes."""
    if size <= 1:
        wanted = pick(rng, (Action, Action, Condition))
        return pick(rng, [leaf for leaf in vocabulary.leaves if isinstance(leaf, wanted)])
    if rng.random() < 0.1:
        return Not(wild_tree(rng, vocabulary, size - 1))
    count = rng.integers(2, 6)
    parts = tuple(wild_tree(rng, vocabulary, rng.integers(1, max(2, size // 2))) for _ in range(count))
    if rng.random() < 0.15:
        return Parallel(parts, int(rng.integers(1, len(parts), endpoint=True)))
    return pick(rng, (Fallback, Sequence, Sequence))(parts)


def mutant(rng, task):
    """A reference tree with a few of its leaves replaced or wrapped: it gets further than a wild tree."""
    tree = parse(pick(rng, task.references).tree)
    chosen = {int(at) for at in rng.integers(len(leaves(tree)), size=2)}
    count = iter(range(len(leaves(tree))))

    def changed(node):
        if isinstance(node, Action | Condition):
            if next(count) not in chosen:
                return node
            return Fallback((node, wild_tree(rng, task.vocabulary, 3)))
        return Not(changed(node.child)) if isinstance(node, Not) else type(node)(tuple(map(changed, node.children)))

    return changed(tree)


def trees(task):
    rngs = [np.random.default_rng(seed) for seed in SEEDS]
    return [
        *(parse(reference.tree) for reference in task.references),
        *(mutant(rng, task) for rng in rngs),
        *(wild_tree(rng, task.vocabulary, 24) for rng in rngs),
    ]


def played(task, tree, scenario, *, stochastic):
    """The return of an episode in plain Python, and each tick's answers."""
    world = PlainPickPlace(task, tree, scenario, stochastic=stochastic)
    ticks = list(play(world, tree))
    return world.reward, ticks


@pytest.mark.parametrize("stochastic", [False, True], ids=["certain", "stochastic"])
@pytest.mark.parametrize("name", list(TASKS))
def test_returns_and_ticks_are_equal_on_every_episode(name, stochastic):
    domain = PickPlace(PickPlaceParameters(name, stochastic))
    scenarios = np.arange(EPISODES) + 2**32 * 7
    for tree in trees(TASKS[name]):
        outcome = domain.simulate(compile_policy(tree, domain.vocabulary.index), scenarios)
        episodes = [played(TASKS[name], tree, int(scenario), stochastic=stochastic) for scenario in scenarios]
        counts = Counter(occurrence for _, ticks in episodes for tick in ticks for occurrence, _ in tick)
        assert outcome.returns.tolist() == [reward for reward, _ in episodes]
        assert outcome.ticks.tolist() == [counts[occurrence] for occurrence in range(len(leaves(tree)))]


def test_the_trees_compared_have_every_kind_of_node_and_every_leaf():
    for task in TASKS.values():
        nodes = [node for tree in trees(task) for node in walk(tree)]
        assert {type(node) for node in nodes} == {Fallback, Sequence, Not, Parallel, Action, Condition}
        assert {node for node in nodes if isinstance(node, Action | Condition)} == set(task.vocabulary.leaves)


def test_every_leaf_answers_all_that_the_vocabulary_declares_and_nothing_else():
    task = TASKS["S3"]
    answers = {leaf: set() for leaf in task.vocabulary.leaves}
    for tree in trees(task):
        row = leaves(tree)
        for scenario in range(EPISODES):
            for occurrence, status in chain.from_iterable(played(task, tree, scenario, stochastic=True)[1]):
                answers[row[occurrence]].add(status)
    for leaf, kind in task.vocabulary.types.items():
        assert answers[leaf] == (kind.results if isinstance(leaf, Action) else {Status.SUCCESS, Status.FAILURE}), leaf
