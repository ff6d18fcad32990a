"""An episode to watch shows what happens, and only what changes; recorded ones are still played the same way."""

import runpy
from pathlib import Path

import pytest

from grammarbt.bt import compile_policy, parse
from grammarbt_pickplace.domain import PickPlace
from grammarbt_pickplace.parameters import PickPlaceParameters

PLAYTHROUGHS = runpy.run_path(str(Path(__file__).with_name("record_playthroughs.py")))["PLAYTHROUGHS"]


def episode_of(task, tree=None, scenario=0, *, stochastic=False):
    domain = PickPlace(PickPlaceParameters(task, stochastic))
    return domain.episode(compile_policy(parse(tree or domain.references[0].tree), domain.vocabulary.index), scenario)


def events_of(episode):
    return [event for frame in episode.frames for event in frame.events]


@pytest.mark.parametrize("world", PLAYTHROUGHS.worlds)
def test_the_best_known_tree_goes_through_the_recorded_ticks(world):
    assert PLAYTHROUGHS.told(world) == PLAYTHROUGHS.recorded(world)


def test_the_picture_has_tables_goal_cubes_and_the_robot_within_its_box():
    episode = episode_of("S3")
    roles = [mark.role for mark in episode.marks]
    assert [roles.count(role) for role in ("place", "goal", "object", "robot")] == [4, 1, 3, 1]
    left, bottom, right, top = episode.box
    assert all(left < mark.x < right and bottom < mark.y < top for mark in episode.marks)


def test_placed_cubes_lie_on_the_goal_at_the_end():
    episode = episode_of("S3")
    *_, marks = episode.pictures()
    goal = marks["goal"]
    assert {(marks[f"cube {n}"].x, marks[f"cube {n}"].y) for n in range(3)} == {(round(goal.x, 2), round(goal.y, 2))}
    assert sorted(event for event in events_of(episode) if "placed" in event) == [f"cube {n} placed" for n in range(3)]


def test_the_localisation_error_grows_while_the_robot_is_lost_and_is_small_once_it_knows():
    lost = episode_of("S1", "→( [tuck] [move to pick0] [tuck] )")
    errors = [float(mark.label.split()[0]) for frame in lost.frames for mark in frame.changes if mark.name == "error"]
    assert errors
    assert min(errors) > 1
    found = [mark for frame in episode_of("S1").frames for mark in frame.changes if mark.name == "error"]
    assert all(float(mark.label.split()[0]) <= 0.2 for mark in found)


def test_a_tick_changes_few_marks_and_a_tick_that_only_begins_an_action_changes_none():
    frames = episode_of("S1").frames
    assert frames[0].changes == ()
    assert max(len(frame.changes) for frame in frames) <= 6


def test_each_run_of_the_second_task_begins_with_the_cube_on_another_table():
    episode = episode_of("S2")
    assert events_of(episode).count("cube 0 placed") == 3
    assert {"at pick0", "at pick1", "at pick2"} <= set(events_of(episode))


def test_what_goes_wrong_is_told():
    news = {
        event for scenario in range(300) for event in events_of(episode_of("S1", scenario=scenario, stochastic=True))
    }
    assert {"pick failed", "place failed", "localise failed", "cube 0 lost", "lost its way"} <= news
