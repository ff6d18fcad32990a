"""Worlds in plain Python: played tick by tick, recorded as they change, and with chance that can be looked up."""

import pytest

from grammarbt.bt import Status, parse
from grammarbt.domain import Mark
from grammarbt.domain.chance import mix, uniform
from grammarbt.domain.plain import EpisodeOverError, play, record

STEP_AND_STEP = parse("→( [step] [step] )")


class Stairs:
    """Each step counts; five steps are an episode, also in the middle of a tick."""

    def __init__(self):
        self.reward, self.ticks = 0, []

    @property
    def done(self):
        return self.reward == 5

    def answer(self, leaf, occurrence):
        if self.done:
            raise EpisodeOverError
        self.reward += 1
        return Status.SUCCESS

    def step(self, status):
        self.ticks.append(status)

    def picture(self):
        return (Mark("floor", "line", "ground", 0, 0, 1), Mark("walker", "circle", "robot", self.reward, 0, 1))

    def events(self):
        return ("at the top",) if self.done else ()


def test_an_episode_ends_in_the_middle_of_a_tick():
    stairs = Stairs()
    assert [len(answers) for answers in play(stairs, STEP_AND_STEP)] == [2, 2, 1]
    assert stairs.ticks == [Status.SUCCESS, Status.SUCCESS, None]


def test_a_record_has_every_answer_and_only_the_marks_that_change():
    episode = record(Stairs(), STEP_AND_STEP, (0, -1, 5, 1), "steps")
    assert [mark.name for mark in episode.marks] == ["floor", "walker"]
    assert [[mark.name for mark in frame.changes] for frame in episode.frames] == [["walker"]] * 3
    assert [frame.reward for frame in episode.frames] == [2, 4, 5]
    assert [frame.events for frame in episode.frames] == [(), (), ("at the top",)]
    assert episode.frames[0].answers == ((0, Status.SUCCESS), (1, Status.SUCCESS))


def test_numbers_are_scrambled_as_the_published_generator_does():
    assert [mix(number) for number in range(3)] == [0xE220A8397B1DCDAF, 0x6E789E6AA1B965F4, 0x06C45D188009454F]
    assert all(0 <= mix(number) < 2**64 for number in (0, 1, 2**64 - 1, 2**70, 3**50))


def test_chance_is_even_and_the_same_for_the_same_key():
    numbers = [uniform(key) for key in range(10_000)]
    assert numbers == [uniform(key) for key in range(10_000)]
    assert all(0 <= number < 1 for number in numbers)
    assert sum(numbers) / len(numbers) == pytest.approx(0.5, abs=0.01)


def test_pictures_hold_every_mark_as_it_is_after_each_tick():
    pictures = list(record(Stairs(), STEP_AND_STEP, (0, -1, 5, 1), "steps").pictures())
    assert [[*picture] for picture in pictures] == [["floor", "walker"]] * 4
    assert [picture["walker"].x for picture in pictures] == [0, 2, 4, 5]
