from itertools import pairwise

import pytest

from grammarbt.grammar import parse_tree
from grammarbt.search import Evaluation, RootList
from grammarbt_dagmcts.dag import ROOT, Dag
from grammarbt_dagmcts.draws import Draws
from grammarbt_dagmcts.mcdags import McdagsSearch
from grammarbt_dagmcts.parameters import DagMctsParameters
from grammarbt_dagmcts.rollout import RollOuts, least_steps


@pytest.fixture
def mcdags(context):
    def make(budget=1_000, **changes):
        return McdagsSearch(context(budget=budget), DagMctsParameters(preset="mcdags", **changes))

    return make


@pytest.mark.parametrize(("budget", "length"), [(50_000, 1_000), (200_000, 1_000), (5_000, 100), (20, 1)])
def test_a_round_is_a_fiftieth_of_the_budget_and_no_more_than_a_thousand(mcdags, budget, length):
    assert mcdags(budget).round_length == length
    assert mcdags(budget, round_length=70).round_length == 70


def test_searching_and_annealing_take_turns_after_the_first_rounds(search):
    def rounds(episodes):
        metrics = search(episodes, preset="mcdags", round_length=20, search_rounds=4)[0].metrics()
        return metrics["rounds"], metrics["annealed"]

    assert rounds(100) == (5, 0)
    assert rounds(120) == (6, 1)
    assert rounds(180) == (9, 2)


def test_annealing_proposes_lists_of_sub_trees_met_before(search):
    _, proposals = search(120, preset="mcdags", round_length=20, search_rounds=4)
    met = {part for proposal in proposals[:100] for part in proposal.tree.children}
    annealed = proposals[100:120]
    assert all(part in met for proposal in annealed for part in proposal.tree.children)


def test_annealing_begins_next_to_the_best_tree(search):
    searcher, proposals = search(101, preset="mcdags", round_length=20, search_rounds=4)
    best = searcher.strategy.search.experience
    assert len(best.subtrees) > 3
    (neighbour,) = proposals[100:101]
    trees = [best.grammar.tree(best.grammar.derive(derivation, block)) for block, derivation in best.best]
    assert len(trees) - 1 <= len(neighbour.tree.children) <= len(trees) + 1


def test_annealing_goes_back_to_the_best_list(search):
    def answer(proposal):
        return Evaluation(proposal, (10.0 if proposal.start == 0 else 1.0,))

    searcher, _ = search(300, preset="mcdags", answer=answer, round_length=100, search_rounds=1, reset_after=20)
    assert searcher.strategy.annealing.resets >= 4


def test_cold_annealing_accepts_no_loss(search):
    returns = iter(range(1_000, 0, -1))

    def answer(proposal):
        return Evaluation(proposal, (float(next(returns)),))

    cold, _ = search(200, preset="mcdags", answer=answer, round_length=50, search_rounds=1, heat=1e-9)
    assert cold.metrics()["annealed"] == 1
    assert cold.metrics()["accepted"] == 0


def test_nodes_below_a_positive_reward_are_joined_to_their_ancestors(search):
    def always(value):
        return lambda proposal: Evaluation(proposal, (value,))

    settings = {"preset": "mcdags", "restarts": False, "link_every": 1_000}
    gained = search(100, answer=always(1.0), **settings)[0]
    lost = search(100, answer=always(-1.0), **settings)[0]
    unlinked = search(100, answer=always(-1.0), **settings, ancestor_links=False)[0]
    assert gained.metrics()["nodes"] > lost.metrics()["nodes"] == unlinked.metrics()["nodes"]


def test_now_and_then_the_best_node_of_each_level_is_joined(search):
    def lose(proposal):
        return Evaluation(proposal, (-1.0 - len(proposal.tree.children),))

    settings = {"preset": "mcdags", "restarts": False, "annealing": False, "answer": lose}
    seldom, often = search(300, link_every=400, **settings)[0], search(300, link_every=1, **settings)[0]
    assert often.metrics()["nodes"] > seldom.metrics()["nodes"]


def test_levels_are_the_fewest_productions_from_the_root(search):
    dag = search(200, preset="mcdags", restarts=False)[0].strategy.search.dag
    found = dag.levels()
    assert found[0] == [ROOT]
    assert sorted(node for level in found for node in level) == list(range(len(dag)))
    for number, (level, below) in enumerate(pairwise(found)):
        children = {child for node in level for child in dag.edges.children(node)}
        assert set(below) == children.difference(*found[: number + 1])


def test_only_forms_without_a_reward_count_as_unvisited(mcdags, answer):
    searching = mcdags(restarts=False).search
    dag = searching.dag
    for _ in range(200):
        (roll_out,) = searching.plan(1)
        last = searching.last(roll_out)
        assert dag.rewards.visits[last] == 0 or dag.words[last]
        searching.learn(roll_out, answer(roll_out.proposal))
        assert ROOT in dag.edges.ancestors([last])


@pytest.mark.parametrize("longest", [0, 3, 40])
def test_a_long_roll_out_is_finished_the_shortest_way(grammar, context, longest):
    roll_outs = RollOuts(Dag(grammar), Draws(context().rng), longest)
    lengths = [len(roll_outs.below((), 0).proposal.derivation) for _ in range(200)]
    fewest = RollOuts(Dag(grammar), Draws(context(1).rng), 0)
    shortest = min(len(fewest.below((), 0).proposal.derivation) for _ in range(5))
    assert min(lengths) >= shortest
    assert (max(lengths) == shortest) == (longest == 0)


def test_a_roll_out_spells_the_tree_that_its_derivation_leads_to(mcdags, grammar, answer):
    searching = mcdags(restarts=False).search
    for _ in range(100):
        (roll_out,) = searching.plan(1)
        proposal = roll_out.proposal
        assert grammar.tree(grammar.derive(proposal.derivation)) == proposal.tree
        assert proposal.derivation == parse_tree(grammar, proposal.tree)
        searching.learn(roll_out, answer(proposal))


def test_least_steps_are_those_of_the_shortest_derivations(grammar):
    steps = least_steps(grammar)
    for block in grammar.blocks:
        least = min(steps[production.number] for production in grammar.by_lhs[block])
        assert least == min(len(derivation) for derivation, _ in grammar.enumerate(block))


def test_annealed_trees_are_in_the_language(search, grammar):
    lists = RootList(grammar)
    _, proposals = search(400, preset="mcdags", round_length=20, search_rounds=1, batch=3)
    assert all(lists.recognise(proposal.tree, 10_000) is not None for proposal in proposals)
