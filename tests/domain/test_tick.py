"""Domains in plain Python: what is scored, what is recorded, and what a world may answer."""

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import numpy as np
import pytest

from grammarbt.bt import Status, compile_policy, node_statuses, parse
from grammarbt.domain import ActionType, ConditionType, Group, Mark, TickDomain, Vocabulary, Watchable
from grammarbt.errors import DomainError

EXAMPLE = Path(__file__).parents[2] / "docs" / "examples" / "corridor.py"
TREES = (
    "?( →( (holding cup) [go to door] ) →( [go to cup] [grasp] ) )",
    "?( →( (holding cup) ‖1( [go to door] (at cup) ) ) →( [go to cup] !(!([grasp])) ) )",
)


@pytest.fixture(scope="module")
def corridor():
    spec = spec_from_file_location("corridor_example", EXAMPLE)
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.Corridor()


class Counter(TickDomain):
    """Ten steps; what its leaves answer is up to the test."""

    vocabulary = Vocabulary(
        (
            Group(
                "all",
                (ActionType("act"), ActionType("go", parameters=(("to", ("left", "right")),))),
                (ConditionType("late"),),
            ),
        )
    )
    box = (0.0, 0.0, 10.0, 1.0)

    def __init__(self, holds=lambda _: True, acts=lambda *_, **__: Status.SUCCESS):
        self.holds, self.acts = holds, acts

    def reset(self, rng):
        self.time = 0

    def condition(self, name):
        return self.holds(self.time)

    def action(self, name, **arguments):
        return self.acts(name, **arguments)

    def step(self):
        self.time += 1
        self.done, self.reward = self.time == 10, self.time / 2

    def picture(self):
        return [Mark("track", "line", "path", 0, 0, 1, to_x=10), Mark("robot", "circle", "robot", self.time, 0, 1)]

    def events(self):
        return ["half"] if self.time == 5 else []


def policy_of(domain, text):
    return compile_policy(parse(text), domain.vocabulary.index)


@pytest.mark.parametrize("text", TREES)
def test_an_episode_ends_with_the_return_that_is_scored(corridor, text):
    policy, scenarios = policy_of(corridor, text), np.arange(30)
    returns = corridor.simulate(policy, scenarios).returns
    assert len(set(returns)) > 1
    assert [corridor.episode(policy, int(scenario)).frames[-1].reward for scenario in scenarios] == list(returns)


@pytest.mark.parametrize("text", TREES)
def test_an_episode_holds_every_tick_of_every_leaf(corridor, text):
    policy, tree = policy_of(corridor, text), parse(text)
    frames = corridor.episode(policy, 3).frames
    asked = [occurrence for frame in frames for occurrence, _ in frame.answers]
    counted = corridor.simulate(policy, np.array([3])).ticks
    assert [asked.count(occurrence) for occurrence in range(policy.occurrences)] == list(counted)
    assert all(node_statuses(tree, dict(frame.answers))[0] is not None for frame in frames)


def test_many_scenarios_together_give_what_each_gives_alone(corridor):
    policy, scenarios = policy_of(corridor, TREES[1]), np.arange(600)
    together = corridor.simulate(policy, scenarios)
    assert together.ticks.sum() > 2 * 1_000 * policy.occurrences  # enough for the tree to be compiled on the way
    alone = [corridor.simulate(policy, scenarios[at : at + 1]) for at in range(600)]
    assert [outcome.returns[0] for outcome in alone] == list(together.returns)
    assert sum(outcome.ticks for outcome in alone).tolist() == together.ticks.tolist()


def test_only_what_changes_in_the_picture_is_recorded():
    episode = Counter().episode(policy_of(Counter(), "[act]"), 0)
    assert isinstance(Counter(), Watchable)
    assert [mark.name for mark in episode.marks] == ["track", "robot"]
    assert [[(mark.name, mark.x) for mark in frame.changes] for frame in episode.frames] == [
        [("robot", time)] for time in range(1, 11)
    ]
    assert episode.box == Counter.box
    assert [frame.events for frame in episode.frames].index(("half",)) == 4


def test_a_world_that_draws_nothing_can_be_watched_too(corridor):
    episode = corridor.episode(policy_of(corridor, TREES[0]), 0)
    assert (episode.marks, episode.frames[0].changes, episode.frames[0].events) == ((), (), ())


def test_arguments_reach_the_action():
    seen = []
    domain = Counter(acts=lambda name, **arguments: seen.append((name, arguments)) or Status.RUNNING)
    domain.simulate(policy_of(domain, "→( [act] [go(to=left)] )"), np.array([0]))
    domain.simulate(policy_of(domain, "[go(to=right)]"), np.array([0]))
    assert seen == [("act", {})] * 10 + [("go", {"to": "right"})] * 10


@pytest.mark.parametrize("holds", [lambda time: time > 4, lambda time: np.bool_(time > 4), lambda time: time // 5])
def test_a_condition_may_answer_with_anything_that_is_true_or_false(holds):
    domain = Counter(holds)
    policy = policy_of(domain, "→( (late) [act] )")
    assert domain.simulate(policy, np.array([0])).ticks.tolist() == [10, 5]
    assert {type(status) for frame in domain.episode(policy, 0).frames for _, status in frame.answers} == {Status}


@pytest.mark.parametrize("answer", [None, True, "SUCCESS", 1])
def test_an_action_that_forgets_to_answer_is_named(answer):
    domain = Counter(acts=lambda *_, **__: answer)
    with pytest.raises(DomainError, match=r"\[act\] answered"):
        domain.simulate(policy_of(domain, "→( (late) [act] )"), np.array([0]))
