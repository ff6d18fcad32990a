"""Every behaviour once, smallest first, until the language is finished."""

import numpy as np
import pytest

from grammarbt.bt.canonical import canonical_key
from grammarbt.bt.simplify import size
from grammarbt.domain import NoParameters
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt.search import Evaluation, SearchContext, States, smallest_first
from grammarbt.search.exhaustive import ExhaustiveSearch
from grammarbt.testing import SearcherConformance, SearcherSubject

SMALL = """
%declare ACTION CONDITION
%limit nodes 5
%unique CONDITION in start
start: ACTION | "→" "(" check* ACTION ")" | "?" "(" check ACTION ")"
check: CONDITION | "!" "(" CONDITION ")"
"""


class TestExhaustive(SearcherConformance):
    subject = SearcherSubject("exhaustive")


@pytest.fixture(scope="module")
def small(vocabulary):
    return bind(load_grammar(Source("small.grammar", SMALL)), vocabulary)


def searched(grammar, vocabulary, depends_on):
    context = SearchContext(grammar, vocabulary, np.random.default_rng(0), 10_000, depends_on)
    searcher = ExhaustiveSearch(context, NoParameters())
    trees = []
    while asked := searcher.ask(7):
        trees += [proposal.tree for proposal in asked]
        searcher.tell([Evaluation(proposal, (1.0,) * (proposal.stop - proposal.start)) for proposal in asked])
    return searcher, trees


def words(grammar):
    return [grammar.tree_of(word) for _, word in grammar.enumerate()]


def test_every_behaviour_is_tried_once(small, vocabulary):
    searcher, trees = searched(small, vocabulary, "behaviour")
    keys = [canonical_key(tree, vocabulary.is_pure) for tree in trees]
    assert sorted(keys) == sorted({canonical_key(tree, vocabulary.is_pure) for tree in words(small)})
    assert searcher.metrics()["finished"] == 1.0


def test_every_tree_is_tried_where_the_tree_itself_matters(small, vocabulary):
    _, trees = searched(small, vocabulary, "tree")
    assert len(trees) == len({*words(small)}) == len({*trees})


def test_no_tree_is_smaller_than_the_one_before(small, vocabulary):
    sizes = [size(tree) for tree in searched(small, vocabulary, "tree")[1]]
    assert sizes == sorted(sizes)


@pytest.mark.parametrize("name", ["unique", "small"])
def test_smallest_first_lists_every_derivation_once(grammars, small, name):
    grammar = (grammars | {"small": small})[name]
    expected = [derivation for derivation, _ in grammar.enumerate()]
    assert sorted(smallest_first(States(grammar))) == sorted(expected)
