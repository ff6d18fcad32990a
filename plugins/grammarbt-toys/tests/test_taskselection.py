"""Task selection is exact: known trees are right everywhere, and wrong ones exactly as often as they are."""

from typing import get_args

import numpy as np
import pytest

from grammarbt.bt import Node, compile_policy, format_tree, parse, walk
from grammarbt.testing import tally, wild_tree
from grammarbt_toys.parameters import TaskSelectionParameters
from grammarbt_toys.plain_taskselection import PlainTaskSelection, right_action
from grammarbt_toys.taskselection import TaskSelection, right_tree

KNOWN = "?( →( (c0) [a0] ) →( (c2) (c3) [a6] ) →( (c2) [a2] ) →( (c3) [a3] ) [a1] )"


def outcome_of(tree, last, scenarios=1):
    domain = TaskSelection(TaskSelectionParameters(last))
    return domain.simulate(compile_policy(tree, domain.vocabulary.index), np.arange(scenarios))


def trees_of(last):
    leaves = TaskSelection(TaskSelectionParameters(last)).vocabulary.leaves
    return [wild_tree(np.random.default_rng(number), leaves, 20) for number in range(30)]


@pytest.mark.parametrize("last", range(1, 8))
def test_the_constructed_tree_is_right_in_every_assignment(last):
    assert outcome_of(right_tree(last), last, scenarios=3).returns.tolist() == [1.0] * 3


def test_for_three_conditions_the_construction_gives_the_known_tree():
    assert format_tree(right_tree(3)) == KNOWN


def test_every_part_of_the_constructed_tree_matters():
    tree = right_tree(4)
    parts = tree.children
    for place in range(len(parts)):
        without = type(tree)(parts[:place] + parts[place + 1 :])
        assert outcome_of(without, 4).returns[0] < 1.0


@pytest.mark.parametrize(
    ("tree", "share"),
    [
        ("[a0]", 8 / 16),
        ("?( →( (c0) [a0] ) [a1] )", 10 / 16),
        ("→( (c0) [a0] )", 8 / 16),
        ("(c0)", 0.0),
        ("‖2( [a6] [a0] )", 1 * 2 / 16),
    ],
)
def test_a_simple_trees_return_can_be_counted_by_hand(tree, share):
    assert outcome_of(parse(tree), 3).returns[0] == share


def test_there_is_an_action_for_every_product_and_one_for_c0():
    domain = TaskSelection(TaskSelectionParameters(4))
    names = [leaf.name for leaf in domain.vocabulary.leaves]
    assert names == [f"a{number}" for number in range(25)] + [f"c{number}" for number in range(5)]
    assert right_action((False, True, True, True, True)) == 24


@pytest.mark.parametrize("last", [1, 3, 4])
def test_returns_and_ticks_are_those_of_plain_python(last):
    for tree in [*trees_of(last), right_tree(last)]:
        outcome = outcome_of(tree, last, scenarios=2)
        share, ticks = tally(PlainTaskSelection(last), tree)
        assert outcome.returns.tolist() == [share] * 2
        assert outcome.ticks.tolist() == [2 * count for count in ticks]


def test_the_trees_compared_have_every_kind_of_node():
    assert {type(node) for tree in trees_of(3) for node in walk(tree)} == {*get_args(Node)}
