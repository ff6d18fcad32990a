"""The swarm forages as robots in plain Python do, and as drawn here."""

from collections import Counter
from typing import get_args

import numpy as np
import pytest

from grammarbt.bt import Fallback, Node, compile_policy, format_leaf, parse, walk
from grammarbt.domain.plain import play
from grammarbt.testing import tally, wild_tree
from grammarbt_toys.foraging import VOCABULARY, Foraging
from grammarbt_toys.foraging_kernel import LEAVES
from grammarbt_toys.parameters import ForagingParameters
from grammarbt_toys.plain_foraging import PlainForaging

MANUAL, FORGETFUL = (parse(reference.tree) for reference in Foraging.references)
WILD = [wild_tree(np.random.default_rng(number), VOCABULARY.leaves, 20) for number in range(40)]
TREES = [MANUAL, FORGETFUL, *WILD, *(Fallback((*MANUAL.children[:3], tree, MANUAL.children[-1])) for tree in WILD)]
SMALL = ForagingParameters(size=12, robots=3, sites=2, food=3, sight=2, steps=60)


def outcome_of(tree, parameters, scenarios):
    return Foraging(parameters).simulate(compile_policy(tree, VOCABULARY.index), np.array(scenarios))


def test_the_kernel_knows_the_leaves_of_the_vocabulary_by_their_numbers():
    assert [format_leaf(leaf)[1:-1] for leaf in VOCABULARY.leaves] == list(LEAVES)


def test_returns_and_ticks_are_those_of_plain_python():
    for tree in TREES:
        for scenario in (0, 3, 2**40 + 1):
            outcome = outcome_of(tree, SMALL, [scenario])
            assert (*outcome.returns, outcome.ticks.tolist()) == tally(PlainForaging(SMALL, scenario), tree)


def drawn_row(world):
    """A row: hub H, sites S, food *, a robot r, or R with food."""
    signs = {
        world.hub: "H",
        **dict.fromkeys(world.sites, "S"),
        **dict.fromkeys(filter(world.has_food, world.food), "*"),
    }
    signs.update({robot.place: "R" if robot.carrying else "r" for robot in world.robots})
    return "".join(signs.get((4, column), ".") for column in range(world.parameters.size))


def test_a_playthrough_as_drawn():
    world = PlainForaging(ForagingParameters(size=8, robots=1, sites=1, food=1, steps=5), scenario=0)
    world.robots[0].place, world.sites, world.food = (4, 2), [(4, 0)], Counter([(4, 0)])
    world.robots[0].begin_turn()
    rows = [drawn_row(world), *(drawn_row(world) for _ in play(world, MANUAL))]
    assert rows == ["*.r.H...", "*r..H...", "SR..H...", "S.R.H...", "S..RH...", "S..rH..."]
    assert world.delivered == 1


def test_the_trees_compared_have_every_kind_of_node_and_every_leaf_and_some_bring_food():
    nodes = [node for tree in TREES for node in walk(tree)]
    assert {*map(type, nodes)} == {*get_args(Node)}
    assert len({outcome_of(tree, SMALL, [3]).returns[0] for tree in TREES}) > 2
    assert set(VOCABULARY.leaves) <= set(nodes)


def test_the_batch_does_not_matter():
    scenarios = [5, 900, 5, 2**40]
    alone = [outcome_of(MANUAL, SMALL, [scenario]).returns[0] for scenario in scenarios]
    assert outcome_of(MANUAL, SMALL, scenarios).returns.tolist() == alone
    assert alone[0] == alone[2]


def test_remembering_sites_brings_more_food_and_no_more_than_there_is():
    default = ForagingParameters()
    manual, forgetful = (outcome_of(tree, default, range(100)).returns for tree in (MANUAL, FORGETFUL))
    assert manual.mean() > 1.5 * forgetful.mean() > 0
    assert manual.max() <= default.sites * default.food


@pytest.mark.parametrize("useless", ["[explore]", "[pick up]", "[move towards(thing=hub)]", "(carrying(thing=food))"])
def test_a_single_leaf_brings_nothing(useless):
    assert not outcome_of(parse(useless), SMALL, range(20)).returns.any()
