"""Random search draws words of the grammar and believes in those that did best."""

import numpy as np
import pytest

from grammarbt.bt import parse
from grammarbt.domain import ActionType, ConditionType, Group, NoParameters, Vocabulary
from grammarbt.grammar import bind, load_grammar, shipped_grammars
from grammarbt.search import Evaluation, SearchContext
from grammarbt.search.random import RandomSearch

VOCABULARY = Vocabulary(
    (
        Group("g1", (ActionType("a"), ActionType("b")), (ConditionType("c"),)),
        Group("g2", (ActionType("d"),), (ConditionType("e"),)),
    )
)


@pytest.fixture(scope="module")
def grammar():
    return bind(load_grammar(shipped_grammars()["scheide"]), VOCABULARY)


@pytest.fixture
def search(grammar):
    """A random search over two groups of leaves."""

    def make(seed=0, start=None):
        return RandomSearch(
            SearchContext(grammar, VOCABULARY, np.random.default_rng(seed), 100, start=start), NoParameters()
        )

    return make


def told(searcher, n, score):
    proposals = searcher.ask(n)
    searcher.tell([Evaluation(proposal, (score(proposal.tree),)) for proposal in proposals])
    return proposals


def test_the_tree_of_a_proposal_is_what_its_derivation_derives(search, grammar):
    for proposal in search().ask(50):
        assert grammar.tree(grammar.derive(proposal.derivation)) == proposal.tree


def test_the_same_stream_gives_the_same_proposals(search):
    assert search(3).ask(20) == search(3).ask(20) != search(4).ask(20)


def test_a_tree_drawn_again_meets_the_next_scenario(search):
    searcher, met = search(), {}
    for _ in range(3_000):
        for proposal in told(searcher, 1, lambda _: 1.0):
            assert proposal.start == met.get(proposal.tree, 0)
            met[proposal.tree] = proposal.stop
    assert max(met.values()) > 1


def test_candidates_come_best_first_and_failures_never(search):
    searcher = search()
    best = max(told(searcher, 200, lambda tree: -len(str(tree))), key=lambda proposal: -len(str(proposal.tree))).tree
    failed = searcher.ask(1)[0]
    searcher.tell([Evaluation(failed, (), status="failed", error="broken")])
    candidates = searcher.candidates(500)
    lengths = [len(str(tree)) for tree in candidates]
    assert lengths == sorted(lengths)
    assert len(str(candidates[0])) == len(str(best))
    assert searcher.candidates(3) == candidates[:3]


def test_the_start_tree_comes_first(search):
    start = parse("→( [a] [b] )")
    assert search(start=start).ask(2)[0].tree == start
