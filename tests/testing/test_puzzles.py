"""Puzzles say truly what is worth most, and drive a searcher as long as asked."""

import numpy as np
import pytest

from grammarbt.domain import NoParameters
from grammarbt.search import Evaluation
from grammarbt.search.exhaustive import ExhaustiveSearch
from grammarbt.search.random import RandomSearch
from grammarbt.testing import errands, letters

PUZZLES = {"letters": letters(), "errands": errands()}


@pytest.fixture(params=PUZZLES)
def puzzle(request):
    return PUZZLES[request.param]


def test_no_tree_is_worth_more_than_the_solution(puzzle):
    words = [puzzle.grammar.tree_of(word) for _, word in puzzle.grammar.enumerate()]
    assert puzzle.solution in words
    assert max(map(puzzle.value, words)) == puzzle.value(puzzle.solution)


def test_a_scenario_has_the_same_noise_for_every_tree(puzzle):
    trees = [puzzle.grammar.tree_of(word) for _, word in puzzle.grammar.enumerate()][:20]
    noise = [[puzzle.score(tree, n) - puzzle.value(tree) for tree in trees] for n in range(500)]
    assert np.allclose(noise, np.mean(noise, axis=1, keepdims=True))
    assert np.std(noise) == pytest.approx(puzzle.noise, rel=0.1)


def test_driving_spends_the_episodes_asked_for(puzzle):
    told = []

    def evaluate(proposal):
        told.append(puzzle.evaluate(proposal))
        return told[-1]

    searcher = RandomSearch(puzzle.context(seed=3), NoParameters())
    proposals = puzzle.drive(searcher, 50, width=7, evaluate=evaluate)
    assert [evaluation.proposal for evaluation in told] == proposals
    assert 50 <= sum(len(evaluation.returns) for evaluation in told) < 50 + 7
    assert proposals == puzzle.drive(RandomSearch(puzzle.context(seed=3), NoParameters()), 50, width=7)


def test_driving_ends_with_the_search(puzzle):
    searcher = ExhaustiveSearch(puzzle.context(), NoParameters())
    puzzle.drive(searcher, 10**6, width=50)
    assert searcher.ask(1) == []
    assert puzzle.value(searcher.candidates(1)[0]) == puzzle.value(puzzle.solution)


def test_answers_may_be_failures(puzzle):
    searcher = RandomSearch(puzzle.context(), NoParameters())
    failed = puzzle.drive(searcher, 5, evaluate=lambda proposal: Evaluation(proposal, (), status="failed"))
    assert len(failed) == 5
    assert not searcher.candidates(1)


def test_other_languages_over_the_same_leaves_can_be_named():
    text = '%declare ACTION\nstart: "→" "(" ACTION ACTION ")"\n'
    puzzle = errands(text, "→( [eat] [walk] )", noise=0.0)
    assert len(list(puzzle.grammar.enumerate())) == 16
    assert puzzle.score(puzzle.solution, 1) == puzzle.score(puzzle.solution, 2) == puzzle.value(puzzle.solution)
