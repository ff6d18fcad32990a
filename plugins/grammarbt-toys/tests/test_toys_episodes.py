"""Episodes to watch show what happens, and only what changes; recorded ones are still played the same way."""

import runpy
from pathlib import Path

import pytest

from grammarbt.bt import compile_policy, parse
from grammarbt_toys.ant import Ant
from grammarbt_toys.foraging import Foraging
from grammarbt_toys.platformer import Platformer
from grammarbt_toys.taskselection import TaskSelection

PLAYTHROUGHS = runpy.run_path(str(Path(__file__).with_name("record_playthroughs.py")))["PLAYTHROUGHS"]
TOYS = {toy.__name__: toy() for toy in (Ant, Foraging, Platformer, TaskSelection)}


def episode_of(name, tree=None, scenario=1):
    toy = TOYS[name]
    return toy.episode(compile_policy(parse(tree or toy.references[0].tree), toy.vocabulary.index), scenario)


def events_of(episode):
    return [event for frame in episode.frames for event in frame.events]


@pytest.mark.parametrize("world", PLAYTHROUGHS.worlds)
def test_the_reference_goes_through_the_recorded_ticks(world):
    assert PLAYTHROUGHS.told(world) == PLAYTHROUGHS.recorded(world)


@pytest.mark.parametrize("name", TOYS)
def test_everything_seen_is_within_the_box(name):
    episode = episode_of(name)
    left, bottom, right, top = episode.box
    marks = [*episode.marks, *(mark for frame in episode.frames for mark in frame.changes)]
    assert all(left <= mark.x <= right and bottom <= mark.y <= top for mark in marks if mark.shade)


@pytest.mark.parametrize("name", TOYS)
def test_a_tick_changes_few_marks(name):
    episode = episode_of(name)
    changed = sum(len(frame.changes) for frame in episode.frames)
    assert changed < 12 * len(episode.frames)


def test_the_ant_has_eaten_all_that_can_no_longer_be_seen():
    episode = episode_of("Ant")
    *_, marks = episode.pictures()
    assert sum(mark.role == "object" and mark.shade == 1.0 for mark in episode.marks) == 89
    assert not [mark for mark in marks.values() if mark.role == "object" and mark.shade]
    assert sum(int(event.split()[0]) for event in events_of(episode)) == 89


def test_the_ant_looks_where_it_goes():
    episode = episode_of("Ant", "→( [turn right] [move forward] [turn left] [turn left] )")
    ants = [mark for frame in episode.frames for mark in frame.changes if mark.name == "ant"]
    assert [(ant.x, ant.y, round(ant.angle, 2)) for ant in ants[:2]] == [(0, 30, 1.57), (1, 30, 3.14)]


def test_the_swarm_delivers_what_the_sites_lose():
    episode = episode_of("Foraging")
    delivered = sum("delivered" in event for event in events_of(episode))
    assert delivered == episode.frames[-1].reward > 0
    *_, marks = episode.pictures()
    left = [mark for mark in marks.values() if mark.role == "object" and mark.shade]
    carried = sum("*" in mark.label for mark in marks.values() if mark.role == "robot")
    assert sum(int(mark.label or 1) for mark in left) + carried + delivered == 40


def test_the_game_says_how_it_ended():
    endings = {
        events_of(episode_of("Platformer", "?( →( (on ground) [jump] [right] ) [right] )", n))[-1] for n in range(9)
    }
    assert endings == {"fell into a gap", "met an enemy"}
    assert "at the end of the level" in {events_of(episode_of("Platformer", scenario=n))[-1] for n in range(9)}


def test_the_game_shows_gaps_and_enemies_ahead():
    hazards = {
        mark.shape for frame in episode_of("Platformer").frames for mark in frame.changes if mark.role == "hazard"
    }
    assert hazards == {"square", "triangle"}


def test_task_selection_tells_wrong_choices():
    episode = episode_of("TaskSelection", "[a1]")
    wrong = events_of(episode)
    assert wrong[0] == "wrong: a1 instead of a0"
    assert episode.frames[-1].reward == 1 - len(wrong) / len(episode.frames)
    *_, marks = episode.pictures()
    chosen = marks["chosen"]
    assert (chosen.label, chosen.role) == ("a1", "hazard")
