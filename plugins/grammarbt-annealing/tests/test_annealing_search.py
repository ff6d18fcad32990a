"""Cold it only climbs, hot it wanders; neighbours meet the scenarios of the present tree."""

import pytest

from grammarbt_annealing.parameters import AnnealingParameters
from grammarbt_annealing.search import Annealing


@pytest.mark.parametrize("width", [1, 6])
def test_it_finds_the_best_tree(context, drive, names, width):
    searcher = Annealing(context(budget=1_500), AnnealingParameters())
    drive(searcher, 1_500, width=width)
    assert names(searcher.candidates(1)[0]) == "aaaaaa"


def test_heat_lets_more_neighbours_in(context, drive):
    accepted = []
    for hottest in (0.001, 10.0):
        searcher = Annealing(context(), AnnealingParameters(hottest=hottest, coldest=0.0005))
        drive(searcher, 300, width=1)
        metrics = searcher.metrics()
        accepted.append(metrics["accepted"] / metrics["steps"])
    assert accepted[0] < 0.5 * accepted[1]


@pytest.mark.parametrize(("cooling", "half"), [("linear", 0.505), ("geometric", 0.1)])
def test_heat_comes_down_as_named(context, drive, cooling, half):
    searcher = Annealing(context(budget=400), AnnealingParameters(cooling=cooling, hottest=1.0, coldest=0.01))
    drive(searcher, 200, width=1)
    strategy = searcher.strategy
    spread = strategy.scorer.returns.variance**0.5
    assert strategy.heat / spread == pytest.approx(half, rel=0.1)


def test_neighbours_are_compared_on_common_scenarios(context, drive):
    proposals = drive(Annealing(context(), AnnealingParameters(episodes=3, first_trees=5)), 300, width=2)
    met = {}
    for proposal in proposals[5:]:
        met.setdefault(proposal.start, set()).add(proposal.tree)
    assert sum(len(trees) > 2 for trees in met.values()) > 10


def test_it_begins_from_the_start_tree(context, drive, grammar):
    start = grammar.tree_of(next(word for _, word in grammar.enumerate()))
    assert Annealing(context(start=start), AnnealingParameters()).ask(1)[0].tree == start
