"""The reference trees, and the plateaus on which searches get stuck, score what was published."""

import pytest

from grammarbt_pickplace.tasks import TASKS

NOISE = 0.1
REACH = "?( (have block) →( [tuck] [move to pick0] ) )"


@pytest.mark.parametrize(
    ("task", "place", "published"),
    [("S1", 0, -15.0), ("S2", 0, -24.2), ("S2", 1, -32.8), ("S3", 0, -35.1), ("S3", 1, -51.3)],
)
def test_reference_trees_score_as_published(task, place, published, returns):
    assert returns(task, TASKS[task].references[place].tree).mean() == pytest.approx(published, abs=NOISE)


def test_knowing_where_it_is_and_doing_nothing_else_is_the_first_plateau(returns):
    assert returns("S1", "→( [localise] )").mean() == pytest.approx(-787, abs=NOISE)


def test_a_robot_that_does_not_localise_itself_scores_less_than_that(returns):
    assert (returns("S1", "[head up]") < -900).all()


def test_holding_the_cube_at_its_table_is_the_second_plateau_with_a_lucky_measurement(returns):
    tree = "→( ?( (have block) →( [localise] [head up] [tuck] [move to pick0] ) ) [head down] [pick] )"
    found = returns("S1", tree, 5000)
    assert found.mean() < -655  # the published figure is the luckiest of many simulations
    assert found.max() == pytest.approx(-647, abs=4)


def test_carrying_the_cube_to_its_goal_without_putting_it_down_is_the_third_plateau(returns):
    tree = f"→( [localise] [head up] {REACH} [head down] [pick] [move to place] )"
    assert returns("S1", tree).mean() == pytest.approx(-265, abs=10)


def test_a_longer_tree_that_gets_it_done_is_on_the_last_plateau(returns):
    fetch = "?( (have block) →( [head up] [tuck] [move to pick0] [head down] [pick] ) )"
    tree = f"?( (task done) →( [localise] {fetch} [head up] [move to place] [head down] [place] ) )"
    assert -25 < returns("S1", tree).mean() < -15.1


@pytest.mark.parametrize("task", list(TASKS))
def test_trees_score_less_when_actions_can_go_wrong(task, returns):
    tree = TASKS[task].references[0].tree
    assert returns(task, tree, stochastic=True).mean() < returns(task, tree).mean() - 1


def test_every_node_costs_half_a_point(returns):
    tree = TASKS["S1"].references[0].tree
    longer = returns("S1", f"→( {tree} )")
    assert longer == pytest.approx(returns("S1", tree) - 0.5)
