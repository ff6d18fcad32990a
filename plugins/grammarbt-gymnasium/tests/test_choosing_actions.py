"""How a tree drives an environment: what a tick does, and what an episode returns."""

import gymnasium
import pytest
from gymnasium_worlds import domain, policy, returns

from grammarbt.bt import Status, leaves, parse
from grammarbt.domain import scenario_numbers
from grammarbt_gymnasium.domain import seed_of


def test_each_tick_takes_the_action_it_chose():
    assert returns(domain("Echo-v0"), "[action 2]", [0]) == [6.0]


def test_a_condition_sees_the_observation_before_the_step():
    assert returns(domain("Echo-v0"), "?( →( (clock is(value=1)) [action 2] ) [action 1] )", [0]) == [4.0]


def test_a_tick_without_an_action_takes_the_idle_one():
    assert returns(domain("Echo-v0"), "(clock is(value=1))", [0]) == [0.0]
    assert returns(domain("Echo-v0", idle="action 2"), "(clock is(value=1))", [0]) == [6.0]


def test_of_several_actions_in_a_parallel_node_the_last_counts():
    assert returns(domain("Echo-v0"), "‖2( [action 2] [action 1] )", [0]) == [3.0]


def test_actions_that_start_elsewhere_than_at_0_are_taken_as_they_are_numbered():
    assert returns(domain("Echo-v0", options="start=5,actions=2"), "[action 1]", [0]) == [18.0]


def test_an_episode_ends_after_max_steps():
    assert returns(domain("Echo-v0", max_steps=2), "[action 1]", [0]) == [2.0]


def test_an_environment_without_an_end_is_stopped():
    assert returns(domain("Echo-v0", options="ends=false"), "[action 1]", [0]) == [1_000.0]


@pytest.mark.parametrize(("env", "steps"), [("CartPole-v1", 500), ("MountainCar-v0", 200)])
def test_the_environments_own_limit_holds(env, steps):
    assert domain(env).environment.max_steps == steps


@pytest.mark.parametrize("env", ["CartPole-v1", "MountainCar-v0", "Acrobot-v1"])
def test_episodes_are_those_of_the_environment_with_all_its_wrappers(env):
    of = domain(env)
    chosen = of.references[0].tree
    episode = of.episode(policy(of, chosen), 7)
    wrapped = gymnasium.make(env)
    wrapped.reset(seed=seed_of(7))
    names = [group.name for group in of.vocabulary.groups]
    total, done = 0.0, False
    for frame in episode.frames:
        assert not done
        occurrence = next(occurrence for occurrence, status in frame.answers if status is Status.RUNNING)
        action = names.index(leaves(parse(chosen))[occurrence].name)
        _, reward, terminated, truncated, _ = wrapped.step(action)
        total += reward
        done = terminated or truncated
    assert done
    assert returns(of, chosen, [7]) == [total]


def test_seeds_of_different_runs_and_of_validation_differ():
    numbers = [*scenario_numbers(0, 0, 500), *scenario_numbers(1, 0, 500), *scenario_numbers(0, 2**31, 2**31 + 500)]
    seeds = [seed_of(int(number)) for number in numbers]
    assert len(set(seeds)) == len(seeds)
    assert all(0 <= seed < 2**31 for seed in seeds)
