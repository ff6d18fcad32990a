"""The game plays as it does in plain Python, and as drawn here."""

from typing import get_args

import numpy as np
import pytest

from grammarbt.bt import Fallback, Node, compile_policy, format_leaf, parse, walk
from grammarbt.domain.plain import play
from grammarbt.testing import tally, wild_tree
from grammarbt_toys.parameters import PlatformerParameters
from grammarbt_toys.plain_platformer import PlainGame, draw_level
from grammarbt_toys.platformer import VOCABULARY, Platformer
from grammarbt_toys.platformer_kernel import LEAVES

MANUAL, UNARMED = (parse(reference.tree) for reference in Platformer.references)
WILD = [wild_tree(np.random.default_rng(number), VOCABULARY.leaves, 24) for number in range(60)]
TREES = [MANUAL, UNARMED, *WILD, *(Fallback((tree, *MANUAL.children)) for tree in WILD)]


def outcome_of(tree, scenarios, parameters=None):
    return Platformer(parameters).simulate(compile_policy(tree, VOCABULARY.index), np.array(scenarios))


def drawn(game):
    """The rows from the top: the player P, or X when it is out, enemies e, ground and walls #."""
    rows = [["#" if ground is not None and y < ground else "." for ground in game.ground] for y in range(3, -2, -1)]
    for column, _ in game.enemies:
        rows[3][column] = "e"
    rows[3 - game.y][game.x] = "P" if game.alive else "X"
    return ["".join(row) for row in rows]


def drawings(level, tree, steps):
    """The row of the player, the enemies and the walls, and the two above it, after every step."""
    game = PlainGame(level, steps)
    return [" ".join(drawn(game)[1:4]) for _ in play(game, parse(tree))]


def test_the_kernel_knows_the_leaves_of_the_vocabulary_by_their_numbers():
    assert [format_leaf(leaf)[1:-1] for leaf in VOCABULARY.leaves] == list(LEAVES)


def test_returns_and_ticks_are_those_of_plain_python():
    for number, tree in enumerate(TREES):
        for scenario in (number, number + 2**40):
            outcome = outcome_of(tree, [scenario], PlatformerParameters(columns=60, steps=80))
            expected = tally(PlainGame(draw_level(scenario, 60), steps=80), tree)
            assert (*outcome.returns, outcome.ticks.tolist()) == expected


def test_the_trees_compared_have_every_kind_of_node_and_nearly_every_leaf():
    nodes = [node for tree in TREES for node in walk(tree)]
    assert {*map(type, nodes)} == {*get_args(Node)}
    assert len(set(VOCABULARY.leaves) - set(nodes)) <= 2
    assert len({outcome_of(tree, [1]).returns[0] for tree in TREES}) > 3


def test_a_jump_over_a_gap_as_drawn():
    assert drawings("_   _", "→( [jump] [right] )", 4) == [
        "..... .P... .....",
        "..P.. ..... .....",
        "..... ...P. .....",
        "..... ..... ....P",
    ]


def test_a_walk_into_a_gap_ends_there():
    game = PlainGame("__ __", steps=10)
    assert len(list(play(game, parse("[right]")))) == 3
    assert (game.farthest, game.alive, drawn(game)[4]) == (2, False, "##X##")


@pytest.mark.parametrize(
    ("level", "tree", "rows"),
    [
        ("_2__", "→( [jump] [right] )", [".... P#.. .#..", ".P.. .#.. .#.."]),
        ("___e", "→( [right] )", [".... .... .P.e", ".... .... ..X."]),
        ("___e", "→( [shoot] )", [".... .... P...", ".... .... P..."]),
        ("_e__", "→( [right] )", [".... .... .X.."]),
    ],
)
def test_a_short_playthrough_as_drawn(level, tree, rows):
    assert drawings(level, tree, len(rows)) == rows


def test_the_batch_does_not_matter():
    scenarios = [5, 900, 5, 2**40]
    alone = [outcome_of(MANUAL, [scenario]).returns[0] for scenario in scenarios]
    assert outcome_of(MANUAL, scenarios).returns.tolist() == alone
    assert alone[0] == alone[2]


def test_most_levels_can_be_won_by_hand_and_few_without_shooting():
    manual, unarmed = (outcome_of(tree, range(500)).returns for tree in (MANUAL, UNARMED))
    end = PlatformerParameters().columns - 1
    assert (manual == end).mean() > 0.5
    assert (unarmed == end).mean() < 0.1
    assert manual.max() == end


def test_levels_have_gaps_walls_and_enemies_between_free_ends():
    levels = [draw_level(scenario, 100) for scenario in range(20)]
    assert set("".join(levels)) == set("_ 12e")
    assert all(set(level[:8] + level[-5:]) == {"_"} for level in levels)
