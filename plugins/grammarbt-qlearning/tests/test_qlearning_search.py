"""Values lead to good productions, and chance comes down with the budget."""

import pytest

from grammarbt_qlearning.parameters import QLearningParameters
from grammarbt_qlearning.search import QLearning

VIEWS = ("place", "progress", "state")


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("trace", [0.0, 0.5, 1.0])
def test_good_words_come_more_often_with_time(context, drive, names, view, trace):
    proposals = drive(QLearning(context(budget=600), QLearningParameters(view=view, trace=trace)), 600, width=1)
    early, late = ([names(one.tree).count("a") for one in part] for part in (proposals[:150], proposals[-150:]))
    assert sum(late) > 1.3 * sum(early)


def test_chance_comes_down_over_its_share_of_the_budget(context, drive):
    searcher = QLearning(context(budget=400), QLearningParameters(first_chance=0.8, last_chance=0.2, cooled=0.5))
    chances = []
    for _ in range(4):
        chances.append(searcher.metrics()["chance"])
        drive(searcher, 100)
    assert chances[0] == 0.8
    assert chances[1] == pytest.approx(0.5, abs=0.05)
    assert chances[2:] == pytest.approx([0.2, 0.2])


def test_views_tell_more_and_more_states_apart(context, drive):
    found = []
    for view in VIEWS:
        searcher = QLearning(context(), QLearningParameters(view=view))
        drive(searcher, 300)
        found.append(searcher.metrics()["states"])
    assert found == sorted(found)
    assert found[0] > 1


def test_it_ends_when_nothing_new_comes_up(context, drive):
    searcher = QLearning(context(), QLearningParameters(first_chance=0.0, last_chance=0.0))
    proposals = drive(searcher, 5_000, answer=lambda tree, scenario: float(sum(map(ord, str(tree)))), width=1)
    assert len(proposals) < 5_000
    assert searcher.ask(1) == []
