"""The ant walks, turns, sees and eats as written down by hand, and as an ant in plain Python does."""

from typing import get_args

import numpy as np
import pytest

from grammarbt.bt import Fallback, Node, compile_policy, parse, walk
from grammarbt.testing import tally, wild_tree
from grammarbt_toys.ant import VOCABULARY, Ant
from grammarbt_toys.ant_kernel import LEAVES, simulate
from grammarbt_toys.parameters import AntParameters
from grammarbt_toys.plain_ant import PlainAnt
from grammarbt_toys.program import make_program
from grammarbt_toys.trail import read_trail, santa_fe_rows, santa_fe_trail

KOZA = parse(Ant.references[0].tree)
WILD = [wild_tree(np.random.default_rng(number), VOCABULARY.leaves, 20) for number in range(30)]
TREES = [KOZA, *WILD, *(Fallback((KOZA.children[0], tree)) for tree in WILD)]
SANTA_FE = santa_fe_rows()

SMALL_TRAIL = [
    "S##.",
    "..#.",
    "..##",
]  # fmt: skip
FOLLOW_OR_TURN_RIGHT = "?( →( (food ahead) [move forward] ) [turn right] )"

PLAYTHROUGHS = [
    (FOLLOW_OR_TURN_RIGHT, "MMrMMrrrM"),
    ("→( [turn left] [move forward] [move forward] [turn right] [move forward] )", "lmmrmlMmrM"),
    ("?( (food ahead) →( [turn left] [turn left] [move forward] ) )", "........."),
    ("→( [turn left] (food ahead) [move forward] )", "llll"),
    ("?( !(food ahead) →( [move forward] [turn right] ) )", "Mr....."),
    ("‖2( [move forward] [turn right] )", "Mrmrmrmrmrmr"),
]
"""A letter a step: moved, turned left or right, nothing; a capital where the ant ate."""


class WritingAnt(PlainAnt):
    """Writes down what it does."""

    written = ""

    def answer(self, leaf, occurrence):
        before = self.reward, self.time
        status = super().answer(leaf, occurrence)
        if self.time > before[1]:
            letter = leaf.name.removeprefix("turn ")[0]
            self.written += letter.upper() if self.reward > before[0] else letter
        return status

    def step(self, status):
        super().step(status)
        self.written = self.written.ljust(self.time, ".")


def eaten_in(tree, rows, steps):
    program = make_program(compile_policy(tree, VOCABULARY.index))
    return simulate(program, read_trail(rows), steps), program.ticks.tolist()


def test_the_trail_has_89_pellets_on_32_by_32_cells_and_none_under_the_ant():
    assert santa_fe_trail().shape == (32, 32)
    assert santa_fe_trail().sum() == 89
    assert not santa_fe_trail()[0, 0]


def test_the_kernel_knows_the_leaves_of_the_vocabulary_by_their_numbers():
    assert [leaf.name for leaf in VOCABULARY.leaves] == list(LEAVES)


def test_the_reference_eats_every_pellet_within_the_steps():
    ant = Ant()
    outcome = ant.simulate(compile_policy(KOZA, VOCABULARY.index), np.arange(3))
    assert outcome.returns.tolist() == [santa_fe_trail().sum()] * 3


def test_an_episode_leaves_the_trail_as_it_was():
    before = santa_fe_trail().copy()
    Ant().simulate(compile_policy(KOZA, VOCABULARY.index), np.arange(1))
    assert (santa_fe_trail() == before).all()


@pytest.mark.parametrize(("tree", "written"), PLAYTHROUGHS)
def test_a_playthrough_is_as_written_down(tree, written):
    ant = WritingAnt(SMALL_TRAIL, len(written))
    tally(ant, parse(tree))
    assert ant.written == written


@pytest.mark.parametrize(("tree", "written"), PLAYTHROUGHS)
def test_the_compiled_ant_has_eaten_as_much_after_every_step(tree, written):
    eaten = [eaten_in(parse(tree), SMALL_TRAIL, steps)[0] for steps in range(len(written) + 1)]
    assert eaten == [written[:steps].count("M") for steps in range(len(written) + 1)]


@pytest.mark.parametrize("steps", [1, 7, 100, 600])
def test_pellets_and_ticks_are_those_of_plain_python(steps):
    for tree in TREES:
        assert eaten_in(tree, SANTA_FE, steps) == tally(PlainAnt(SANTA_FE, steps), tree)


def test_the_trees_compared_have_every_kind_of_node_and_some_of_them_eat():
    assert {type(node) for tree in TREES for node in walk(tree)} == {*get_args(Node)}
    assert len({eaten_in(tree, SANTA_FE, 600)[0] for tree in TREES}) > 5


def test_fewer_steps_never_mean_more_pellets():
    policy = compile_policy(KOZA, VOCABULARY.index)
    pellets = [Ant(AntParameters(steps)).simulate(policy, np.arange(1)).returns[0] for steps in range(1, 601, 10)]
    assert pellets == sorted(pellets)
    assert pellets[0] < pellets[-1]
