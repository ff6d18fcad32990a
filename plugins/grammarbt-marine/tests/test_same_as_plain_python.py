"""The compiled simulator and the one in plain Python agree on every number."""

import contextlib
from typing import get_args

import numpy as np
import pytest

from grammarbt.bt import (
    Action,
    Condition,
    Fallback,
    Node,
    Not,
    Parallel,
    Sequence,
    Status,
    children,
    compile_policy,
    leaves,
    parse,
    walk,
)
from grammarbt.testing import wild_tree
from grammarbt_marine.domain import Marine
from grammarbt_marine.parameters import MarineParameters
from grammarbt_marine.plain import PlainMarine
from grammarbt_marine.plain_robot import takes_step
from grammarbt_marine.references import EXTENDED_REFERENCES
from grammarbt_marine.vocabulary import EXTENDED_VOCABULARY, VOCABULARY

SUCCESS, FAILURE, RUNNING = Status.SUCCESS, Status.FAILURE, Status.RUNNING
EXTENDED, MANUAL, BEST_ORDER, THOROUGH = (parse(reference.tree) for reference in EXTENDED_REFERENCES)

WORLDS = {
    "sparse": {"preset": "sparse"},
    "scheide": {"preset": "scheide"},
    "two robots": {"robots": 2, "horizon": 120},
    "three robots of scheide": {"preset": "scheide", "robots": 3},
    "slow": {"extra_leaves": True, "speed": 0.5, "battery_low": 5.0, "battery_dead": 9.0},
    "full": {"vertices": 23, "roadmaps": 3, "targets": 10, "mines": 0, "objects": 11, "horizon": 90},
    "long edges": {
        "vertices": 23,
        "roadmaps": 3,
        "thing_share": 0.4,
        "sensor": "classifier",
        "edge_cost": "length",
        "speed": 0.1,
    },
}
"""Parameters of worlds besides the default one; few shapes of their tables, as each is compiled anew."""


def pick(rng, options):
    return options[rng.integers(len(options))]


def wild(vocabulary, number):
    """Most robots with such a tree soon stand still."""
    return wild_tree(np.random.default_rng(number), vocabulary.leaves, 24)


def busy(vocabulary, manual, number):
    """Some of the sub-trees that work, in any order, and now and then something wild between them."""
    rng = np.random.default_rng(number)
    conditions = [leaf for leaf in vocabulary.leaves if isinstance(leaf, Condition)]
    extra = Sequence((pick(rng, conditions), pick(rng, conditions), wild_tree(rng, vocabulary.leaves, 4)))
    parts = [*manual.children[:-2], extra]
    rng.shuffle(parts)
    tree = Fallback((*parts[1:], *manual.children[-2:]))
    return tree if rng.random() < 0.5 else Parallel((tree, wild_tree(rng, vocabulary.leaves, 3)), 1)


TREES = [
    *(MANUAL, BEST_ORDER, THOROUGH),
    *(busy(VOCABULARY, MANUAL, number) for number in range(11)),
    *(wild(VOCABULARY, number) for number in range(6)),
]
EXTENDED_TREES = [
    *(EXTENDED, MANUAL),
    *(busy(EXTENDED_VOCABULARY, EXTENDED, number) for number in range(6)),
    *(wild(EXTENDED_VOCABULARY, number) for number in range(6)),
]


def assert_equal(marine, plain, tree, scenarios):
    outcome = marine.simulate(compile_policy(tree, marine.vocabulary.index), scenarios)
    returns, ticks = plain.simulate(tree, scenarios)
    assert outcome.returns.tolist() == returns
    assert outcome.ticks.tolist() == ticks


@pytest.fixture(scope="module")
def plain(marine):
    return PlainMarine(marine)


@pytest.mark.parametrize("number", range(len(TREES)))
def test_returns_and_ticks_are_equal_on_every_episode(number, marine, plain):
    assert_equal(marine, plain, TREES[number], np.arange(100 if number < 12 else 30))


@pytest.mark.parametrize("world", WORLDS)
def test_they_are_equal_in_other_worlds_and_teams(world):
    marine = Marine(MarineParameters(**WORLDS[world]))
    plain = PlainMarine(marine)
    episodes = 100 if world in {"scheide", "two robots"} else 6
    for tree in EXTENDED_TREES if marine.parameters.extra_leaves else TREES[:10]:
        assert_equal(marine, plain, tree, np.arange(episodes) + 2**32 * 7)


def test_the_trees_compared_have_every_kind_of_node_and_every_leaf():
    for trees, vocabulary in ((TREES, VOCABULARY), (EXTENDED_TREES, EXTENDED_VOCABULARY)):
        nodes = [node for tree in trees for node in walk(tree)]
        assert {type(node) for node in nodes} == {*get_args(Node)}
        assert {node for node in nodes if isinstance(node, Action | Condition)} == set(vocabulary.leaves)
    assert (len(TREES), len(EXTENDED_TREES)) == (20, 14)


class HorizonReachedError(Exception):
    pass


class TreeWalk:
    """Ticks a tree as it is written, not as it is compiled, for a team of one."""

    def __init__(self, plain, tree, scenario):
        self.sea, self.tree, self.ticks = plain.episode(scenario), tree, [0] * len(leaves(tree))

    def play(self):
        with contextlib.suppress(HorizonReachedError):
            while True:
                before = self.sea.step
                self.tick(self.tree, 0)
                if self.sea.step == before:
                    self.pass_step()
        return self.sea.reward

    def pass_step(self):
        self.sea.pass_step()
        if self.sea.step >= self.sea.rules.horizon:
            raise HorizonReachedError

    def tick(self, node, first):
        """Tick a node whose first leaf is the tree's leaf number `first`."""
        if isinstance(node, Action | Condition):
            self.ticks[first] += 1
            status = self.sea.robots[0].answer(node)
            if takes_step(node, status):
                self.pass_step()
            return status
        if isinstance(node, Not):
            status = self.tick(node.child, first)
            return {SUCCESS: FAILURE, FAILURE: SUCCESS}.get(status, status)
        statuses = []
        for child in children(node):
            statuses.append(self.tick(child, first))
            result = decided(node, statuses)
            if result is not None:
                return result
            first += len(leaves(child))
        return {Fallback: FAILURE, Sequence: SUCCESS, Parallel: RUNNING}[type(node)]


def decided(node, statuses):
    """What a control node answers after these answers of its children, or None to go on."""
    if isinstance(node, Fallback):
        return statuses[-1] if statuses[-1] != FAILURE else None
    if isinstance(node, Sequence):
        return statuses[-1] if statuses[-1] != SUCCESS else None
    if statuses.count(SUCCESS) >= node.successes:
        return SUCCESS
    return FAILURE if statuses.count(FAILURE) > len(node.children) - node.successes else None


def test_a_robot_ticks_its_tree_as_it_is_written(plain):
    for tree in TREES:
        walks = [TreeWalk(plain, tree, scenario) for scenario in range(4)]
        returns, ticks = plain.simulate(tree, range(4))
        assert [walk.play() for walk in walks] == returns
        assert np.sum([walk.ticks for walk in walks], axis=0).tolist() == ticks


def answers_of_a_restless_robot(sea):
    """What each leaf answers when any leaf may follow any other, each often several times."""
    rng = np.random.default_rng(1)
    answers = {leaf: set() for leaf in EXTENDED_VOCABULARY.leaves}
    leaf, (robot,) = EXTENDED_VOCABULARY.leaves[0], sea.robots
    for _ in range(20_000):
        leaf = leaf if rng.random() < 0.8 else pick(rng, EXTENDED_VOCABULARY.leaves)
        answers[leaf].add(robot.answer(leaf))
        sea.pass_step()
    return answers


def test_every_leaf_answers_all_that_the_vocabulary_declares_and_nothing_else():
    small = {"vertices": 30, "roadmaps": 1, "horizon": 20_000, "battery_low": 5.0}
    plain = PlainMarine(Marine(MarineParameters(**small, extra_leaves=True)))
    answers = answers_of_a_restless_robot(plain.episode(0))
    for leaf, kind in EXTENDED_VOCABULARY.types.items():
        assert answers[leaf] == (kind.results if isinstance(leaf, Action) else {SUCCESS, FAILURE}), leaf
