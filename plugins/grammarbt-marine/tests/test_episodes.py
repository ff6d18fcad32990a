"""Episodes to watch and to read are the episodes that are scored."""

import json
import runpy
from pathlib import Path

import attrs
import numpy as np
import pytest

from grammarbt.bt import compile_policy, leaves, node_statuses, parse
from grammarbt.domain import Watchable
from grammarbt_marine.domain import Marine
from grammarbt_marine.parameters import MarineParameters

WORLDS = {
    "default": {},
    "sparse": {"preset": "sparse"},
    "scheide": {"preset": "scheide"},
    "team": {"robots": 2},
    "team of scheide": {"preset": "scheide", "robots": 3},
}
PLAYTHROUGHS = runpy.run_path(str(Path(__file__).with_name("record_playthroughs.py")))["PLAYTHROUGHS"]


@pytest.fixture(scope="module", params=WORLDS)
def watched(request):
    """A domain, its manual tree, and an episode of that."""
    marine = Marine(MarineParameters(**WORLDS[request.param]))
    tree = parse(marine.references[0].tree)
    return marine, tree, marine.episode(compile_policy(tree, marine.vocabulary.index), 3)


def test_the_reward_grows_to_the_return_and_every_tick_is_there(watched):
    marine, tree, episode = watched
    outcome = marine.simulate(compile_policy(tree, marine.vocabulary.index), np.array([3]))
    assert isinstance(marine, Watchable)
    assert episode.frames[-1].reward == outcome.returns[0]
    ticks = [0] * len(leaves(tree))
    for frame in episode.frames:
        for occurrence, _ in frame.answers:
            ticks[occurrence] += 1
    assert ticks == outcome.ticks.tolist()


def test_the_answers_of_a_tick_tell_what_the_tree_answered(watched):
    _, tree, episode = watched
    assert all(node_statuses(tree, dict(frame.answers))[0] is not None for frame in episode.frames)


def test_events_account_for_the_return(watched):
    marine, _, episode = watched
    p = marine.parameters
    worth = {
        "target reported": p.target_reward,
        "mine disarmed": p.mine_reward,
        "object picked up": p.pick_up_reward,
        "object delivered": p.object_reward,
    }
    events = [event.split(": ")[-1] for frame in episode.frames for event in frame.events]
    assert sum(worth.get(event, 0.0) for event in events) == episode.frames[-1].reward > 0


def test_the_picture_has_all_that_there_is(watched):
    marine, _, episode = watched
    roles = [mark.role for mark in episode.marks if not mark.name.startswith(("belief", "vertex", "edge"))]
    vertices, record = marine.parameters.vertices, marine.roadmaps[3]
    counts = dict(zip(("goal", "hazard", "object"), record["count"].tolist(), strict=True))
    assert {role: roles.count(role) for role in counts} == counts
    assert roles.count("robot") == marine.parameters.robots
    assert sum(mark.role == "place" for mark in episode.marks) == vertices
    assert {"start", "drop-off", "comms"} <= {mark.label for mark in episode.marks}
    left, bottom, right, top = episode.box
    assert all(left < mark.x < right and bottom < mark.y < top for mark in episode.marks)
    assert len({mark.name for mark in episode.marks}) == len(episode.marks)


def test_what_is_dealt_with_fades(watched):
    _, _, episode = watched
    done = [event.split(": ")[-1] for frame in episode.frames for event in frame.events]
    *_, marks = episode.pictures()
    faded = [mark.name.split()[0] for mark in marks.values() if mark.shade in {0.0, 0.25}]
    assert faded.count("mine") == done.count("mine disarmed")
    assert faded.count("object") == done.count("object picked up")
    assert faded.count("target") == done.count("target reported")


def test_a_long_episode_stays_small(watched):
    _, _, episode = watched
    default = {field.name: field.default for field in attrs.fields(type(episode.marks[0]))}

    def said(marks):
        return [{k: v for k, v in attrs.asdict(mark).items() if v != default[k]} for mark in marks]

    frames = [[frame.answers, frame.reward, said(frame.changes), frame.events] for frame in episode.frames]
    assert len(json.dumps([said(episode.marks), frames], separators=(",", ":"))) < 200_000


def test_a_robot_whose_battery_dies_is_lost():
    marine = Marine(MarineParameters("scheide", battery_dead=0.05, roadmaps=1))
    episode = marine.episode(compile_policy(parse("[coverage]"), marine.vocabulary.index), 0)
    assert episode.frames[-1].events == ("battery dead",)
    assert len(episode.frames) < marine.parameters.horizon
    *_, marks = episode.pictures()
    assert marks["robot 1"].label == "lost"


@pytest.mark.parametrize("world", PLAYTHROUGHS.worlds)
def test_the_manual_tree_goes_through_the_recorded_ticks(world):
    assert PLAYTHROUGHS.told(world) == PLAYTHROUGHS.recorded(world)
