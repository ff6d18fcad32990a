from array import array
from typing import get_args

import pytest

from grammarbt.search import Arm, BanditName, make_bandit
from grammarbt_dagmcts.rewards import NEVER_ZERO, Rewards

NODES = 4


@pytest.fixture
def credited(context):
    """A rule, columns, and arms that were given the same rewards."""

    def make(name):
        bandit, rewards, arms, rng = make_bandit(name, 1.0), Rewards(), [Arm() for _ in range(NODES)], context().rng
        for _ in arms:
            rewards.add_node()
        for _ in range(300):
            reward, nodes = float(rng.random()), rng.permutation(NODES)[:2].tolist()
            bandit.observe(reward)
            rewards.credit(nodes, bandit, reward)
            for node in nodes:
                bandit.credit(arms[node], reward)
        return bandit, rewards, arms

    return make


@pytest.mark.parametrize("name", get_args(BanditName))
def test_a_rule_rates_a_node_as_an_arm_with_the_same_rewards(credited, name):
    bandit, rewards, arms = credited(name)
    for node, arm in enumerate(arms):
        assert bandit.index(rewards.arm(node), 20.5, 300) == bandit.index(arm, 20.5, 300)
        assert rewards.mean(node) == arm.mean


@pytest.mark.parametrize("name", get_args(BanditName))
def test_the_most_urgent_node_is_the_arm_with_the_highest_index(credited, context, name):
    bandit, rewards, arms = credited(name)
    rng = context(1).rng
    chosen = set()
    for _ in range(100):
        selections, draws = array("I", rng.integers(1, 100, NODES).tolist()), rng.random(NODES).tolist()
        indices = [
            bandit.index(arm, selected + draw + NEVER_ZERO, 300)
            for arm, selected, draw in zip(arms, selections, draws, strict=True)
        ]
        best = rewards.most_urgent(range(NODES), bandit, (selections, iter(draws).__next__), 300)
        assert best == indices.index(max(indices))
        chosen.add(best)
    assert len(chosen) > 1 or name == "ucb1-normal2"


def test_the_mean_of_a_node_without_a_reward_is_nothing():
    rewards = Rewards()
    rewards.add_node()
    assert rewards.mean(0) == 0.0
