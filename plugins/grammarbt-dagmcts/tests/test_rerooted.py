import numpy as np
import pytest

from grammarbt.bt import behave_alike, canonical_key, leaves
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt.search import (
    BlockDag,
    Evaluation,
    RootList,
    Runner,
    behaviour_of,
    closes,
    judge,
    next_stage,
    piece_of,
    reached_positions,
    trimmed,
)


@pytest.fixture
def rng():
    return np.random.default_rng(5)


@pytest.fixture
def food(grammar, context):
    return BlockDag(grammar, grammar.blocks[0], behaviour_of(context()), 1_000)


def words_of(dag, rng, n=400):
    return {dag.draw(rng)[1].tree for _ in range(n)}


def test_walks_draw_every_behaviour_by_one_word(grammar, food, rng):
    every = {canonical_key(grammar.tree_of(word)) for _, word in grammar.enumerate(food.block)}
    drawn = words_of(food, rng, 3_000)
    assert food.words == len(every) == len(drawn)
    assert {canonical_key(tree) for tree in drawn} == every


def test_kept_words_are_the_shortest_of_their_behaviour(grammar, food, rng):
    drawn = words_of(food, rng)
    for _, word in grammar.enumerate(food.block):
        tree = grammar.tree_of(word)
        same = [other for other in drawn if behave_alike(other, tree)]
        assert all(len(leaves(other)) <= len(leaves(tree)) for other in same)


def test_short_words_come_first(food, rng):
    sizes = [food.draw(rng)[1].size for _ in range(400)]
    counts = np.bincount(sizes)
    per_word = counts / np.maximum(np.bincount([len(leaves(tree)) for tree in words_of(food, rng, 3_000)]), 1)
    assert per_word[1] > per_word[3]


def test_trees_that_matter_themselves_are_all_kept(grammar, context):
    block = grammar.blocks[0]
    dag = BlockDag(grammar, block, behaviour_of(context(depends_on="tree")), 1_000)
    assert dag.words == len({word for _, word in grammar.enumerate(block)})


def test_blocks_too_large_to_list_are_sampled(grammar, context, rng):
    dag = BlockDag(grammar, grammar.blocks[0], behaviour_of(context()), 3)
    assert dag.words == 3
    assert len(words_of(dag, rng)) > 3


def test_a_prefix_is_kept(food, rng):
    _, piece = food.draw(rng)
    for _ in range(20):
        _, other = food.draw(rng, piece.derivation[:2])
        assert other.derivation[:2] == piece.derivation[:2]


def test_lists_outside_the_language_have_no_tree(grammar, rng):
    lists = RootList(grammar)
    food, rest, move = (piece_of(grammar, block, grammar.sample(rng, block)) for block in grammar.blocks)
    assert lists.assemble([food]) is None
    assert lists.assemble([food, food]) is None
    assert lists.assemble([move, food, rest]).tree.children == (move.tree, food.tree, rest.tree)


def test_limits_on_the_whole_tree_are_kept(grammar, vocabulary, context, rng):
    text = grammar.grammar.source.text + "%limit nodes 6\n"
    limited = RootList(bind(load_grammar(Source("limited.grammar", text)), vocabulary))
    assert limited.fits(rng)
    dags = [BlockDag(limited.grammar, block, behaviour_of(context()), 1_000) for block in limited.grammar.blocks]
    sizes = set()
    for _ in range(300):
        pieces = [dag.draw(rng)[1] for dag in dags[:2]]
        fits = sum(piece.size for piece in pieces) + 3 + not_nodes(pieces) <= 6
        sizes.add(fits)
        assert (limited.assemble(pieces) is not None) == fits
    assert sizes == {True, False}


def not_nodes(pieces):
    return sum(str(piece.tree).count("Not(") for piece in pieces)


def test_a_race_is_judged_ever_later():
    stages, done = [], 0
    while done < 96:
        done = next_stage(done, 96)
        stages.append(done)
    assert stages == [1, 2, 4, 8, 16, 32, 64, 96]


@pytest.mark.parametrize(
    ("gains", "verdict"),
    [
        ([0.0], "reject"),
        ([5.0], "go on"),
        ([5.0, -6.0], "reject"),
        ([5.0, 5.0, 5.0, 4.0], "accept"),
        ([20.0, 0.0, 0.0, 1.0], "go on"),
        ([5.0, -4.0, 1.0, 1.0], "go on"),
        ([4.0, -1.0, 3.0, -1.0, 2.0, -1.0, 1.0, 1.0], "accept"),
    ],
)
def test_verdicts(gains, verdict):
    assert judge(gains, 8) == verdict


def test_a_rejection_is_final_without_a_gain_or_after_enough_episodes():
    assert closes([0.0], 96)
    assert closes([9.0, -1.0, -2.0, -2.0, -2.0, -2.0, -1.0, -1.0], 96)
    assert not closes([1.0, -2.0], 96)


def runner_for(grammar, rng, ticks):
    pieces = [piece_of(grammar, block, grammar.sample(rng, block)) for block in grammar.blocks]
    listed = RootList(grammar).assemble(pieces)
    counts = [count for piece, count in zip(pieces, ticks, strict=True) for _ in range(piece.size)]
    return Runner(listed, 0, ticks=counts, watched=4)


def test_sub_trees_that_never_ran_are_dropped(grammar, rng):
    root = runner_for(grammar, rng, (3, 0, 2))
    shorter = trimmed(root, RootList(grammar))
    assert shorter.listed.pieces == (root.listed.pieces[0], root.listed.pieces[2])
    assert len(shorter.ticks) == len(leaves(shorter.listed.tree))
    assert 0 not in shorter.ticks


def test_two_sub_trees_stay(grammar, rng):
    root = runner_for(grammar, rng, (3, 0, 0))
    assert trimmed(root, RootList(grammar)).listed.pieces == root.listed.pieces[:2]


def test_nothing_is_dropped_before_four_episodes(grammar, rng):
    root = runner_for(grammar, rng, (3, 0, 0))
    root.watched = 3
    assert trimmed(root, RootList(grammar)) is root
    assert reached_positions(root) == 4


def test_reached_positions_end_with_the_last_sub_tree_that_ran(grammar, rng):
    assert reached_positions(runner_for(grammar, rng, (3, 1, 0))) == 2
    assert reached_positions(runner_for(grammar, rng, (3, 0, 1))) == 4


def test_trees_race_on_the_scenarios_of_their_root(search):
    searcher, proposals = search(600)
    strategy = searcher.strategy
    worlds = range(strategy.root.start, strategy.root.start + 96)
    first = [proposal for proposal in proposals if proposal.start in worlds]
    assert {proposal.tree for proposal in first} > {strategy.root.listed.tree}
    assert all(proposal.stop <= worlds.stop for proposal in first)


def test_no_race_asks_twice_for_a_scenario(search):
    _, proposals = search(800, first_trees=1, restart_trees=1)
    asked = [(proposal.tree, scenario) for proposal in proposals for scenario in range(proposal.start, proposal.stop)]
    assert len(asked) == len(set(asked))


def test_it_restarts_when_nothing_is_accepted(search):
    def answer(proposal):
        return Evaluation(proposal, (1.0,) * (proposal.stop - proposal.start))

    searcher, _ = search(600, answer=answer, restart_after=50, first_trees=5, restart_trees=5)
    assert searcher.metrics()["restarts"] > 2
    assert searcher.metrics()["accepted"] == 0
