import math

import numpy as np
import pytest

from grammarbt.search import Arm, ThresholdAscent, Ucb1, make_bandit

RULES = ("ucb1", "ucb1-tuned", "ucb1-normal2", "threshold-ascent")


def play(bandit, rng, means, pulls=2_000):
    """Pull the most urgent arm again and again; gives the share of pulls that went to each arm."""
    arms = [Arm() for _ in means]
    for trial in range(pulls):
        indices = [bandit.index(arm, arm.visits, trial) if arm.visits > 1 else float("inf") for arm in arms]
        chosen = int(np.argmax(indices))
        reward = float(rng.normal(means[chosen], 0.2))
        bandit.observe(reward)
        bandit.credit(arms[chosen], reward)
    return [arm.visits / pulls for arm in arms]


@pytest.mark.parametrize("rule", RULES)
def test_the_best_arm_is_pulled_most(rule):
    shares = play(make_bandit(rule, 0.5), np.random.default_rng(1), (0.2, 0.9, 0.5))
    assert shares[1] > 0.6
    assert min(shares) > 0


def test_arms_know_the_moments_of_their_rewards():
    rewards = np.random.default_rng(2).normal(3.0, 2.0, 50)
    arm = Arm()
    for reward in rewards:
        arm.add(float(reward))
    assert arm.mean == pytest.approx(rewards.mean())
    assert arm.variance == pytest.approx(rewards.var())


def test_scaling_the_rewards_changes_no_choice():
    small = play(Ucb1(0.5), np.random.default_rng(3), (0.2, 0.9, 0.5))
    bandit, rng = Ucb1(0.5), np.random.default_rng(3)
    arms = [Arm() for _ in range(3)]
    for trial in range(2_000):
        indices = [bandit.index(arm, arm.visits, trial) if arm.visits > 1 else float("inf") for arm in arms]
        chosen = int(np.argmax(indices))
        reward = 1024.0 * float(rng.normal((0.2, 0.9, 0.5)[chosen], 0.2))
        bandit.observe(reward)
        bandit.credit(arms[chosen], reward)
    assert [arm.visits / 2_000 for arm in arms] == small


def test_threshold_ascent_counts_only_the_best_rewards():
    bandit, low, high = ThresholdAscent(best=2), Arm(), Arm()
    for arm, reward in [(low, 1.0), (low, 2.0), (high, 3.0), (high, 4.0), (low, 2.5)]:
        bandit.observe(reward)
        bandit.credit(arm, reward)
    assert bandit.threshold == 3.0
    assert bandit.index(high, 2, 5) > bandit.index(low, 2, 5)
    assert low.kept == []
    assert high.kept == [3.0, 4.0]


def uniform_arm(bandit, rewards):
    arm = Arm()
    for reward in rewards:
        bandit.observe(reward)
        bandit.credit(arm, reward)
    return arm


def test_ucb1_uniform_is_the_middle_of_the_range_and_a_bonus_as_wide_as_it():
    bandit = make_bandit("ucb1-uniform", 0.5)
    arm = uniform_arm(bandit, (3.0, 1.0, 1.5, 7.0))
    assert bandit.index(arm, 4, 10) == pytest.approx(4.0 + 0.5 * 6.0 * math.sqrt(6 * 4 * math.log(10)))


def test_ucb1_uniform_leaves_a_plateau():
    bandit = make_bandit("ucb1-uniform", 1.0)
    flat, wide = uniform_arm(bandit, (5.0, 5.0, 5.0)), uniform_arm(bandit, (3.0, 5.5))
    assert bandit.index(flat, 3, 5) == 5.0
    assert bandit.index(wide, 2, 5) > bandit.index(flat, 3, 5)


def test_ucb1_uniform_stays_with_one_of_two_equal_arms():
    bandit = make_bandit("ucb1-uniform", 1.0)
    often, seldom = uniform_arm(bandit, (4.0, 6.0, 5.0, 5.0)), uniform_arm(bandit, (4.0, 6.0))
    assert bandit.index(often, 4, 6) > bandit.index(seldom, 2, 6)
