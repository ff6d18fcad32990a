"""What observations become: features, thresholds and conditions."""

import numpy as np
import pytest
from gymnasium_worlds import domain

from grammarbt.bt import format_leaf
from grammarbt_gymnasium.conditions import thresholds
from grammarbt_gymnasium.features import Number
from grammarbt_gymnasium.rollout import random_rollout
from grammarbt_gymnasium.views import view_of

UNIFORM = np.linspace(-1.0, 1.0, 10_001)


def conditions(of):
    return {kind.name: dict(kind.parameters).get("value") for kind in of.vocabulary.groups[0].conditions}


def test_every_kind_of_space_becomes_conditions_and_texts_are_left_out():
    found = conditions(domain("Echo-v0"))
    assert found["clock is"] == ("0", "1", "2", "3")
    assert found["lamp"] is None
    assert found["switches0"] is None
    assert found["dials1 is"] == ("1", "2", "3", "4")
    assert found["pair0 is"] == ("0", "1", "2")
    assert "said is" not in found


def test_features_are_read_from_the_right_places():
    environment = domain("Echo-v0").environment
    view = view_of(environment)
    observation, _ = environment.env.reset(seed=1)
    values = dict(zip([feature.name for feature in view.features], view.read(observation), strict=True))
    corners = observation["pair"][1].ravel().tolist()
    assert [values[f"pair1{corner}"] for corner in range(4)] == corners
    assert (values["clock"], values["lamp"], values["switches0"], values["switches1"]) == (0, 0, 1, 0)
    assert (values["dials0"], values["dials1"], values["pair0"]) == (2, 3, 1)  # places among the labels


def test_known_environments_have_names():
    found = domain("CartPole-v1").vocabulary
    assert [group.name for group in found.groups] == ["push left", "push right"]
    assert {kind.name for kind in found.groups[0].conditions} == {
        "cart position above",
        "cart velocity above",
        "pole angle above",
        "pole velocity above",
    }


def test_blackjacks_numbers_are_counts_and_its_ace_a_flag():
    found = conditions(domain("Blackjack-v1"))
    assert len(found["player sum is"]) == 32
    assert len(found["player sum above"]) == 31
    assert found["usable ace"] is None


def test_quantiles_of_what_is_symmetric_are_symmetric_and_hold_0():
    lopsided = np.abs(UNIFORM) * np.array([1.0, 1.0, 1.0, -1.0] * 2_500 + [1.0])
    assert thresholds(Number("angle", -np.inf, np.inf), lopsided, 5, "quantiles") == (-0.7, -0.3, 0.0, 0.3, 0.7)


def test_quantiles_of_anything_else_are_those_of_its_values():
    found = thresholds(Number("height", 0.0, 9.0), UNIFORM + 1.0, 3, "quantiles")
    assert found == pytest.approx((0.5, 1.0, 1.5))


def test_a_grid_lies_between_the_bounds_and_else_between_what_was_seen():
    assert thresholds(Number("x", -4.0, 4.0), UNIFORM, 3, "grid") == (-2.0, 0.0, 2.0)
    assert thresholds(Number("x"), UNIFORM, 3, "grid") == (-0.5, 0.0, 0.5)


def test_what_takes_few_values_is_cut_between_them():
    assert thresholds(Number("leg", 0.0, 1.0), np.array([0.0, 1.0, 1.0, 0.0]), 9, "quantiles") == (0.5,)


def test_what_never_changes_is_not_asked_about():
    assert thresholds(Number("constant"), np.zeros(50), 9, "quantiles") == ()


@pytest.mark.parametrize("n", [1, 2, 5, 30])
def test_there_are_at_most_as_many_thresholds_as_asked_for(n):
    found = conditions(domain("MountainCar-v0", thresholds=n, rollout=500))
    assert all(1 <= len(values) <= n for values in found.values())


def test_thresholds_ascend_and_are_short():
    for values in conditions(domain("MountainCar-v0")).values():
        assert sorted(values, key=float) == list(values)
        assert max(map(len, values)) <= 6


def test_the_roll_out_is_always_the_same():
    environment = domain("Acrobot-v1").environment
    view = view_of(environment)
    once, again = (random_rollout(environment, view, 700) for _ in range(2))
    assert np.array_equal(once, again)
    assert once.shape == (700, 6)


def test_every_condition_is_answered_in_the_state_it_speaks_of():
    of = domain("CartPole-v1")
    texts = [format_leaf(leaf) for leaf in of.vocabulary.leaves]
    assert "(pole angle above(value=0.0))" in texts
    assert len(set(texts)) == len(texts)
