"""What the tests of simulators share: wild trees, counted ticks, and recorded episodes."""

from typing import get_args

import numpy as np
import pytest

from grammarbt.bt import Action, Condition, Node, Status, format_tree, parse, walk
from grammarbt.testing import Playthroughs, tally, wild_tree
from grammarbt.testing.worlds import Lamps

LEAVES = Lamps.vocabulary.leaves


class Counter:
    """Counts to four; each action adds one, and nothing can be asked."""

    def __init__(self):
        self.reward = 0.0

    @property
    def done(self):
        return self.reward >= 4

    def answer(self, leaf, occurrence):
        self.reward += isinstance(leaf, Action)
        return Status.FAILURE if isinstance(leaf, Condition) else Status.SUCCESS

    def step(self, status):
        pass


def test_wild_trees_have_every_kind_of_node_and_every_leaf():
    trees = [wild_tree(np.random.default_rng(number), LEAVES, 20) for number in range(30)]
    nodes = [node for tree in trees for node in walk(tree)]
    assert {*map(type, nodes)} == {*get_args(Node)}
    assert {node for node in nodes if isinstance(node, Action | Condition)} == set(LEAVES)


def test_a_wild_tree_is_the_same_for_the_same_seed_and_larger_for_a_larger_size():
    trees = [[wild_tree(np.random.default_rng(seed), LEAVES, size) for seed in range(100)] for size in (1, 10, 40)]
    assert trees[2] == [wild_tree(np.random.default_rng(seed), LEAVES, 40) for seed in range(100)]
    small, medium, large = (sum(len(list(walk(tree))) for tree in row) for row in trees)
    assert 100 == small < medium < large


def test_every_leaf_ticked_is_counted():
    assert tally(Counter(), parse("→( ?( (no) [a] ) [b] (no) [c] )")) == (4.0, [2, 2, 2, 2, 0])


@pytest.fixture
def lamps(tmp_path):
    return Playthroughs(tmp_path / "texts", {"lamps": (Lamps, (0, 1))})


def test_what_was_recorded_is_told_again(lamps):
    lamps.record()
    assert lamps.recorded("lamps") == lamps.told("lamps")
    assert lamps.told("lamps").count(format_tree(parse(Lamps.references[0].tree))) == 2


def test_a_change_of_the_rules_shows(lamps):
    class Cheaper(Lamps):
        def reset(self, rng):
            super().reset(rng)
            self.price["red"] = 1.0

    lamps.record()
    changed = Playthroughs(lamps.folder, {"lamps": (Cheaper, (0, 1))})
    assert changed.told("lamps") != changed.recorded("lamps")
