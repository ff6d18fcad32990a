"""Cold it only climbs, hot it wanders; neighbours meet the scenarios of the present tree."""

import pytest

from grammarbt.testing import letters
from grammarbt_annealing.parameters import AnnealingParameters
from grammarbt_annealing.search import Annealing

PUZZLE = letters()


@pytest.mark.parametrize("width", [1, 6])
def test_it_finds_the_best_tree(width):
    searcher = Annealing(PUZZLE.context(budget=1_500), AnnealingParameters())
    PUZZLE.drive(searcher, 1_500, width=width)
    assert searcher.candidates(1)[0] == PUZZLE.solution


def test_heat_lets_more_neighbours_in():
    accepted = []
    for hottest in (0.001, 10.0):
        searcher = Annealing(PUZZLE.context(budget=400), AnnealingParameters(hottest=hottest, coldest=0.0005))
        PUZZLE.drive(searcher, 300)
        metrics = searcher.metrics()
        accepted.append(metrics["accepted"] / metrics["steps"])
    assert accepted[0] < 0.5 * accepted[1]


@pytest.mark.parametrize(("cooling", "half"), [("linear", 0.505), ("geometric", 0.1)])
def test_heat_comes_down_as_named(cooling, half):
    searcher = Annealing(PUZZLE.context(budget=400), AnnealingParameters(cooling=cooling, hottest=1.0, coldest=0.01))
    PUZZLE.drive(searcher, 200)
    strategy = searcher.strategy
    spread = strategy.scorer.returns.variance**0.5
    assert strategy.heat / spread == pytest.approx(half, rel=0.1)


def test_neighbours_are_compared_on_common_scenarios():
    searcher = Annealing(PUZZLE.context(budget=400), AnnealingParameters(episodes=3, first_trees=5))
    proposals = PUZZLE.drive(searcher, 300, width=2)
    met = {}
    for proposal in proposals[5:]:
        met.setdefault(proposal.start, set()).add(proposal.tree)
    assert sum(len(trees) > 2 for trees in met.values()) > 10


def test_it_begins_from_the_start_tree():
    searcher = Annealing(PUZZLE.context(start=PUZZLE.solution), AnnealingParameters())
    assert searcher.ask(1)[0].tree == PUZZLE.solution
