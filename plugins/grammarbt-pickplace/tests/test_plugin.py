"""What the plugin announces, how light that is, what its grammar spans and what its parameters refuse."""

import subprocess
import sys
from importlib.resources import files
from time import perf_counter

import attrs
import numpy as np
import pytest

from grammarbt.bt import Action, Condition, Fallback, Sequence, format_tree, leaves, parse, walk
from grammarbt.grammar import Source, bind, load_grammar, parse_tree
from grammarbt_pickplace import hooks
from grammarbt_pickplace.domain import PickPlace
from grammarbt_pickplace.kernel.leaves import HAVE_BLOCK
from grammarbt_pickplace.parameters import PickPlaceParameters
from grammarbt_pickplace.program import LEAVES
from grammarbt_pickplace.tasks import TASKS

MOST_NODES = 50


def announced():
    texts = {spec.name: files(spec.package).joinpath(spec.resource) for spec in hooks.grammarbt_grammars()}
    return {name: load_grammar(Source(name, text.read_text(encoding="utf-8"))) for name, text in texts.items()}


GRAMMARS = announced()
PUBLISHED = GRAMMARS["pickplace-published"]


def test_announcing_the_components_imports_neither_numpy_nor_numba():
    code = "import sys, grammarbt_pickplace.hooks; print(sorted({'numpy', 'numba'} & set(sys.modules)))"
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert printed.strip() == "[]"


@pytest.mark.parametrize("grammar", GRAMMARS.values(), ids=list(GRAMMARS))
@pytest.mark.parametrize("task", TASKS.values(), ids=list(TASKS))
def test_each_grammar_binds_to_every_task_within_a_second(task, grammar):
    begin = perf_counter()
    assert bind(grammar, task.vocabulary).start()
    assert perf_counter() - begin < 1.0


def in_search_space(tree):
    """Whether control nodes take turns and end with no condition."""
    controls = [node for node in walk(tree) if not isinstance(node, Action | Condition)]
    nested = [type(child) is type(node) for node in controls for child in node.children]
    ends = [isinstance(node.children[-1], Condition) for node in controls]
    return {type(node) for node in controls} <= {Fallback, Sequence} and not any(nested) and not any(ends)


@pytest.mark.parametrize("grammar", GRAMMARS.values(), ids=list(GRAMMARS))
def test_all_trees_of_each_grammar_are_in_the_published_search_space(grammar):
    bound = bind(grammar, TASKS["S3"].vocabulary)
    rng = np.random.default_rng(0)
    sampled = [bound.tree(bound.derive(bound.sample(rng))) for _ in range(200)]
    assert all(in_search_space(tree) for tree in sampled)
    assert max(sum(1 for _ in walk(tree)) for tree in sampled) <= MOST_NODES


@pytest.mark.parametrize("task", TASKS.values(), ids=list(TASKS))
def test_the_reference_trees_are_in_the_published_search_space(task):
    assert [reference.name for reference in task.references] in (["best known"], ["best known", "hand-written"])
    for reference in task.references:
        tree = parse(reference.tree)
        assert in_search_space(tree)
        assert sum(1 for _ in walk(tree)) <= MOST_NODES
        assert set(leaves(tree)) <= set(task.vocabulary.leaves)
        assert format_tree(tree) == reference.tree
        assert parse_tree(bind(PUBLISHED, task.vocabulary), tree)


FETCH = "[head down] [pick] [move to place] [place]"
S2_TABLES = "→( [tuck] (table1 visited) [move to pick0] ) →( (table2 visited) [move to pick1] ) [move to pick2]"
S3_TABLES = "→( [tuck] (cube0 placed) [move to pick2] ) →( (cube1 placed) [move to pick0] ) [move to pick1]"
AS_GOOD = {
    "S1": f"?( (task done) →( [localise] [head up] ?( (have block) →( [tuck] [move to pick0] ) ) {FETCH} ) )",
    "S2": f"?( (task done) →( [head up] [localise] ?( (have block) {S2_TABLES} ) {FETCH} ) )",
    "S3": f"?( (task done) →( [head up] [localise] ?( (have block) {S3_TABLES} ) {FETCH} ) )",
}


@pytest.mark.parametrize(("name", "task"), TASKS.items(), ids=list(TASKS))
def test_the_grammar_has_a_tree_as_good_as_the_best_known(name, task, returns):
    assert parse_tree(bind(GRAMMARS["pickplace"], task.vocabulary), parse(AS_GOOD[name]))
    assert returns(name, AS_GOOD[name], 50).mean() >= returns(name, task.references[0].tree, 50).mean() - 1e-9


def test_the_simulator_knows_every_leaf_of_the_vocabulary_and_no_other():
    vocabulary = PickPlace(PickPlaceParameters("S3")).vocabulary
    assert sorted(LEAVES) == sorted(leaf.name for leaf in vocabulary.leaves)
    assert all(isinstance(leaf, Action) == (LEAVES.index(leaf.name) < HAVE_BLOCK) for leaf in vocabulary.leaves)


def test_each_task_adds_leaves_to_the_one_before():
    one, two, three = (set(TASKS[name].vocabulary.leaves) for name in ("S1", "S2", "S3"))
    assert one < two < three
    assert [len(one), len(two), len(three)] == [11, 16, 18]


def test_every_parameter_and_every_leaf_has_help():
    assert all(field.metadata["help"] for field in attrs.fields(PickPlaceParameters))
    assert all(kind.help for task in TASKS.values() for kind in task.vocabulary.types.values())


@pytest.mark.parametrize("wrong", [{"task": "S4"}, {"task": 1}, {"stochastic": "yes"}], ids=str)
def test_wrong_parameters_are_refused(wrong):
    with pytest.raises((ValueError, TypeError), match=next(iter(wrong))):
        PickPlaceParameters(**wrong)
