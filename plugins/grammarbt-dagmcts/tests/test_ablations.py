from importlib.resources import files

import numpy as np
import pytest

from grammarbt.bt import Action, Condition, Not, Sequence, leaves
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt.search import RootList
from grammarbt_dagmcts import hooks

MCDAGS = {"preset": "mcdags", "round_length": 20, "search_rounds": 2}


@pytest.mark.parametrize("preset", ["paper", "mcdags"])
def test_without_the_dag_equal_forms_stay_apart(search, preset):
    merged = search(300, preset=preset, restarts=False)[0].strategy.search.dag
    searcher, _ = search(300, preset=preset, restarts=False, dag=False)
    tree = searcher.strategy.search.dag
    assert len(set(merged.texts)) == len(merged)
    assert len(set(tree.texts)) < len(tree)
    assert max(len(merged.edges.parents(node)) for node in range(len(merged))) > 1
    assert {len(tree.edges.parents(node)) for node in range(len(tree))} == {0, 1}
    assert searcher.metrics()["edges"] == searcher.metrics()["nodes"] - 1


def test_in_a_tree_a_reward_goes_up_one_path(search):
    tree = search(200, preset="paper", restarts=False, dag=False)[0].strategy.search.dag
    visits = tree.rewards.visits
    for node in range(len(tree)):
        assert visits[node] >= sum(visits[child] for child in tree.edges.children(node))


def test_without_annealing_every_round_searches(search):
    full, first = search(200, **MCDAGS)
    without, second = search(200, **MCDAGS, annealing=False)
    assert full.metrics()["annealed"] > 0
    assert without.metrics()["annealed"] == 0
    assert without.metrics()["restarts"] > full.metrics()["restarts"]
    assert first[:60] == second[:60]
    assert first != second


@pytest.mark.parametrize("settings", [MCDAGS, {"preset": "paper", "restart_every": 20}])
def test_without_restarts_one_dag_and_one_grammar_serve_the_whole_search(search, grammar, settings):
    full, _ = search(200, **settings)
    without, _ = search(200, **settings, restarts=False)
    assert full.metrics()["restarts"] > 0 == without.metrics()["restarts"]
    assert full.metrics()["macros"] > 0 == without.metrics()["macros"]
    assert without.metrics()["nodes"] > full.metrics()["nodes"]
    assert without.strategy.search.grammar is grammar


@pytest.fixture(scope="session")
def variant(vocabulary):
    def load(name):
        (spec,) = (spec for spec in hooks.grammarbt_grammars() if spec.name == name)
        text = files(spec.package).joinpath(spec.resource).read_text(encoding="utf-8")
        return bind(load_grammar(Source(spec.resource, text)), vocabulary)

    return load


@pytest.fixture
def trees(variant):
    def sample(name, n=200):
        grammar, rng = variant(name), np.random.default_rng(0)
        return [grammar.tree(grammar.derive(grammar.sample(rng))) for _ in range(n)]

    return sample


def groups_of(tree, vocabulary):
    own = {kind.name: group.name for group in vocabulary.groups for kind in (*group.actions, *group.conditions)}
    return {own[leaf.name] for leaf in leaves(tree)}


def conditions_come_first(part):
    bare = [
        isinstance(child, Condition | Not) for child in part.children if isinstance(child, Action | Condition | Not)
    ]
    return bare == sorted(bare, reverse=True)


def test_without_groups_sub_trees_mix_them(trees, vocabulary):
    mixed = [len(groups_of(part, vocabulary)) for tree in trees("ungrouped") for part in tree.children]
    assert max(mixed) == 3
    assert all(conditions_come_first(part) for tree in trees("ungrouped") for part in tree.children)
    assert all(2 <= len(tree.children) <= 3 for tree in trees("ungrouped"))


def test_without_structure_conditions_stand_anywhere_in_the_sub_tree_of_a_group(trees, vocabulary):
    parts = [part for tree in trees("unstructured") for part in tree.children]
    assert all(len(groups_of(part, vocabulary)) == 1 for part in parts)
    assert not all(conditions_come_first(part) for part in parts)
    assert not all(isinstance(part, Sequence) for part in parts)


def test_a_default_sub_tree_is_an_action_at_the_end(trees):
    for tree in trees("defaulted"):
        (only,) = tree.children[-1].children
        assert isinstance(only, Action)


@pytest.mark.parametrize("name", ["ungrouped", "unstructured", "defaulted"])
def test_every_variant_can_be_annealed(variant, name):
    assert RootList(variant(name)).fits(np.random.default_rng(0))
