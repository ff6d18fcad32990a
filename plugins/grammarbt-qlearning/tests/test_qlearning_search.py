"""Values lead to good productions, and chance comes down with the budget."""

import pytest
from attrs import evolve

from grammarbt.testing import letters
from grammarbt_qlearning.parameters import QLearningParameters
from grammarbt_qlearning.search import QLearning

PUZZLE = letters()
VIEWS = ("place", "progress", "state")


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("trace", [0.0, 0.5, 1.0])
def test_good_words_come_more_often_with_time(view, trace):
    searcher = QLearning(PUZZLE.context(budget=600), QLearningParameters(view=view, trace=trace))
    worth = [PUZZLE.value(proposal.tree) for proposal in PUZZLE.drive(searcher, 600)]
    assert sum(worth[-150:]) > 1.3 * sum(worth[:150])


def test_chance_comes_down_over_its_share_of_the_budget():
    searcher = QLearning(PUZZLE.context(budget=400), QLearningParameters(first_chance=0.8, last_chance=0.2, cooled=0.5))
    chances = []
    for _ in range(4):
        chances.append(searcher.metrics()["chance"])
        PUZZLE.drive(searcher, 100, width=4)
    assert chances[0] == 0.8
    assert chances[1] == pytest.approx(0.5, abs=0.05)
    assert chances[2:] == pytest.approx([0.2, 0.2])


def test_the_view_of_the_place_tells_fewest_states_apart():
    found = []
    for view in VIEWS:
        searcher = QLearning(PUZZLE.context(budget=400), QLearningParameters(view=view))
        PUZZLE.drive(searcher, 300, width=4)
        found.append(searcher.metrics()["states"])
    assert 1 < found[0] < min(found[1:])


def test_it_ends_when_nothing_new_comes_up():
    exact = evolve(PUZZLE, noise=0.0)
    searcher = QLearning(exact.context(), QLearningParameters(first_chance=0.5, last_chance=0.0))
    proposals = exact.drive(searcher, 5_000)
    assert len(proposals) < 5_000
    assert searcher.ask(1) == []
