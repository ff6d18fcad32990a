"""The recorded episode is the episode."""

import json
from itertools import islice

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from grammarbt.bt import Status, node_statuses, parse
from grammarbt.domain import Episode, Frame, Mark
from grammarbt.report.recording import LETTERS, recording, stops_of

TREE = parse("?( →( (a) [b] ) [c] )")
NUMBERS = st.integers(-50, 50).map(lambda number: number / 4)
MARKS = st.builds(
    Mark,
    name=st.sampled_from("xyz"), shape=st.sampled_from(["circle", "line"]), role=st.sampled_from(["robot", "goal"]),
    x=NUMBERS, y=NUMBERS, size=NUMBERS, shade=st.sampled_from([0.0, 0.5, 1.0]), label=st.sampled_from(["", "here"]),
    to_x=NUMBERS,
)  # fmt: skip
PASSING = ((0, Status.SUCCESS), (1, Status.RUNNING))
FAILING = ((0, Status.FAILURE), (2, Status.SUCCESS))
MARK_LISTS = st.lists(MARKS, max_size=3, unique_by=lambda mark: mark.name).map(tuple)
FRAMES = st.builds(Frame, st.sampled_from([PASSING, FAILING]), NUMBERS, MARK_LISTS)
EPISODES = st.builds(Episode, st.lists(FRAMES, max_size=8).map(tuple), MARK_LISTS)


@given(EPISODES)
def test_marks_can_be_followed_tick_by_tick(episode):
    content = recording(TREE, episode)
    drawn = {number: dict(mark) for number, mark in enumerate(content["marks"])}
    names = [mark.name for mark in episode.marks]
    pictures = islice(episode.pictures(), 1, None)
    for frame, world, (_, _, changes) in zip(episode.frames, pictures, content["frames"], strict=True):
        for mark, (number, news) in zip(frame.changes, changes, strict=True):
            names += [] if mark.name in names else [mark.name]
            assert names[number] == mark.name
            drawn[number] = drawn.get(number, {}) | news
        for number, name in enumerate(names):
            assert Mark(name, **drawn[number]) == world[name]


@given(EPISODES)
def test_a_line_of_letters_says_what_every_node_answered(episode):
    content = recording(TREE, episode)
    for frame, (line, reward, _) in zip(episode.frames, content["frames"], strict=True):
        expected = node_statuses(TREE, dict(frame.answers))
        assert content["statuses"][line] == "".join(LETTERS[status] for status in expected)
        assert reward == frame.reward


def test_three_hundred_ticks_take_tens_of_kilobytes():
    rng = np.random.default_rng(1)
    marks = tuple(Mark(f"belief {at}", "circle", "belief", at % 10, at // 10, 0.3, shade=0.1) for at in range(100))

    def moved():
        seen = (marks[at] for at in rng.choice(100, 6, replace=False))
        beliefs = (Mark(mark.name, "circle", "belief", mark.x, mark.y, 0.3, shade=rng.random()) for mark in seen)
        return (*beliefs, Mark("robot", "triangle", "robot", *rng.random(2), 0.4, angle=rng.random()))

    frames = tuple(Frame((PASSING, FAILING)[tick % 3 > 0], float(tick), moved()) for tick in range(300))
    assert len(json.dumps(recording(TREE, Episode(frames, marks)), separators=(",", ":"))) < 90_000


def test_without_events_the_stops_are_where_another_leaf_decides():
    frames = tuple(Frame(answers, 0.0) for answers in (PASSING, PASSING, FAILING, PASSING))
    assert [(stop.tick, stop.text) for stop in stops_of(TREE, Episode(frames))] == [(1, "[b]"), (3, "[c]"), (4, "[b]")]


def test_events_are_the_stops_where_there_are_any():
    frames = (Frame(PASSING, 0.0), Frame(FAILING, 1.0, (), ("cup grasped",)))
    assert [(stop.tick, stop.text) for stop in stops_of(TREE, Episode(frames))] == [(2, "cup grasped")]
