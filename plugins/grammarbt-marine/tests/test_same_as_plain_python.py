"""The compiled simulator and the one in plain Python agree on every number."""

import contextlib

import numpy as np
import pytest
from marine_reference import HorizonReachedError, PlainMarine

from grammarbt.bt import Action, Condition, Fallback, Not, Parallel, Sequence, Status, compile_policy, parse, walk
from grammarbt_marine.domain import Marine
from grammarbt_marine.parameters import MarineParameters
from grammarbt_marine.vocabulary import VOCABULARY

EPISODES = 200
MANUAL, BEST_ORDER = (parse(reference.tree) for reference in Marine.references)
ACTIONS = [leaf for leaf in VOCABULARY.leaves if isinstance(leaf, Action)]
CONDITIONS = [leaf for leaf in VOCABULARY.leaves if isinstance(leaf, Condition)]


def pick(rng, options):
    return options[rng.integers(len(options))]


def wild_tree(rng, size):
    """Any nesting of all kinds of nodes; most such robots soon stand still."""
    if size <= 1:
        return pick(rng, pick(rng, (ACTIONS, ACTIONS, CONDITIONS)))
    if rng.random() < 0.15:
        return Not(wild_tree(rng, size - 1))
    parts = tuple(wild_tree(rng, rng.integers(1, max(2, size // 2))) for _ in range(rng.integers(2, 5)))
    if rng.random() < 0.2:
        return Parallel(parts, rng.integers(1, len(parts), endpoint=True))
    return pick(rng, (Fallback, Fallback, Sequence))(parts)


def busy_tree(rng):
    """Some of the sub-trees that work, in any order, and now and then something wild between them."""
    parts = [*MANUAL.children[:4], Sequence((pick(rng, CONDITIONS), pick(rng, CONDITIONS), wild_tree(rng, 4)))]
    rng.shuffle(parts)
    tree = Fallback((*parts[1:], *MANUAL.children[4:]))
    return tree if rng.random() < 0.5 else Parallel((tree, wild_tree(rng, 3)), 1)


TREES = [
    *(MANUAL, BEST_ORDER),
    *(busy_tree(np.random.default_rng(number)) for number in range(12)),
    *(wild_tree(np.random.default_rng(number), 24) for number in (2, 6, 7, 8, 10, 11)),
]


@pytest.fixture(scope="module")
def plain(marine):
    return PlainMarine(marine)


@pytest.mark.parametrize("tree", TREES, ids=range(len(TREES)))
def test_returns_and_ticks_are_equal_on_every_episode(tree, marine, plain):
    scenarios = np.arange(EPISODES)
    outcome = marine.simulate(compile_policy(tree, VOCABULARY.index), scenarios)
    returns, ticks = plain.simulate(tree, scenarios)
    assert outcome.returns.tolist() == returns
    assert outcome.ticks.tolist() == ticks


def test_the_trees_compared_have_every_kind_of_node_and_every_leaf():
    nodes = [node for tree in TREES for node in walk(tree)]
    assert {type(node) for node in nodes} == {Fallback, Sequence, Not, Parallel, Action, Condition}
    assert {node for node in nodes if isinstance(node, Action | Condition)} == set(VOCABULARY.leaves)
    assert len(TREES) == 20


def test_other_parameters_give_equal_numbers_too():
    full = MarineParameters(vertices=23, roadmaps=3, targets=10, mines=0, objects=11, horizon=90, pick_up_steps=1)
    marine = Marine(full)
    plain = PlainMarine(marine)
    scenarios = np.arange(40) + 2**32 * 7
    for tree in TREES[:4]:
        outcome = marine.simulate(compile_policy(tree, VOCABULARY.index), scenarios)
        returns, ticks = plain.simulate(tree, scenarios)
        assert outcome.returns.tolist() == returns
        assert outcome.ticks.tolist() == ticks


def answers_of_a_restless_robot(robot):
    """What each leaf answers when any leaf may follow any other, each often several times."""
    rng = np.random.default_rng(1)
    answers = {leaf: set() for leaf in VOCABULARY.leaves}
    leaf = VOCABULARY.leaves[0]
    with contextlib.suppress(HorizonReachedError):
        while True:
            leaf = leaf if rng.random() < 0.8 else pick(rng, VOCABULARY.leaves)
            answers[leaf].add(robot.answer(leaf))
    return answers


def test_every_leaf_answers_all_that_the_vocabulary_declares_and_nothing_else():
    plain = PlainMarine(Marine(MarineParameters(vertices=30, roadmaps=1, horizon=20_000)))
    answers = answers_of_a_restless_robot(plain.robot(scenario=0))
    for leaf, kind in VOCABULARY.types.items():
        assert answers[leaf] == (kind.results if isinstance(leaf, Action) else {Status.SUCCESS, Status.FAILURE}), leaf
