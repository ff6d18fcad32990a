"""What the plugin announces, how light that is, and what a mistake gets for an answer."""

import subprocess
import sys

import attrs
import numpy as np
import pytest
from gymnasium_worlds import domain

from grammarbt.bt import leaves
from grammarbt.errors import DomainError, ParameterError
from grammarbt.testing import DomainConformance, DomainSubject
from grammarbt_gymnasium import environment
from grammarbt_gymnasium.options import read_options
from grammarbt_gymnasium.parameters import GymnasiumParameters


def subject(env, **settings):
    return DomainSubject("gymnasium", {"env": env, "rollout": 500, "max_steps": 40, **settings})


class TestCartPole(DomainConformance):
    subject = subject("CartPole-v1", thresholds=5)


class TestMountainCar(DomainConformance):
    subject = subject("MountainCar-v0", max_steps=200, thresholds=3)


class TestFrozenLake(DomainConformance):
    subject = subject("FrozenLake-v1", max_steps=100)


class TestTaxi(DomainConformance):
    subject = subject("Taxi-v4", max_steps=100)


class TestLunarLander(DomainConformance):
    subject = subject("LunarLander-v3", thresholds=2, max_steps=150)


class TestMiniGrid(DomainConformance):
    subject = subject("MiniGrid-Empty-5x5-v0", max_steps=12)


def test_announcing_the_domain_imports_neither_numpy_nor_gymnasium():
    code = "import sys, grammarbt_gymnasium.hooks; print(sorted({'numpy', 'gymnasium'} & set(sys.modules)))"
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert printed.strip() == "[]"


def test_every_parameter_and_every_leaf_has_help():
    assert all(field.metadata["help"] for field in attrs.fields(GymnasiumParameters))
    for env in ("CartPole-v1", "Taxi-v4", "MiniGrid-Empty-5x5-v0"):
        assert all(kind.help for kind in domain(env).vocabulary.types.values())


def test_trees_of_the_default_grammar_have_at_most_12_leaves():
    grammar = subject("MountainCar-v0").grammar
    rng = np.random.default_rng(3)
    sizes = [len(leaves(grammar.tree(grammar.derive(grammar.sample(rng))))) for _ in range(300)]
    assert max(sizes) <= 12


@pytest.mark.parametrize(
    ("env", "message", "hint"),
    [
        ("CartPol-v1", "no environment 'CartPol-v1'", "CartPole-v1"),
        ("CartPole-v77", "no environment 'CartPole-v77'", "CartPole-v1"),
        ("Taxi-v3", "no environment 'Taxi-v3'", "Taxi-v4"),
        ("Cart Pole", "Cart Pole does not start", "documentation"),
        ("Pendulum-v1", "actions of Pendulum-v1 are not discrete", "CartPole-v1"),
        ("nowhere:Lost-v0", "nowhere:Lost-v0 needs a package", "pip install nowhere"),
    ],
)
def test_an_environment_that_cannot_be_used_is_named_with_a_way_out(env, message, hint):
    with pytest.raises(DomainError) as caught:
        environment.make_environment(GymnasiumParameters(env=env))
    assert message in caught.value.message
    assert hint in (caught.value.hint or "")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("env", "package", "hint"),
    [
        ("LunarLander-v3", "Box2D", "grammarbt-gymnasium[box2d]"),
        ("MiniGrid-Empty-5x5-v0", "minigrid", "grammarbt-gymnasium[minigrid]"),
        ("ALE/Pong-v5", "ale_py", "pip install ale_py"),
    ],
)
def test_a_missing_package_is_asked_for(env, package, hint):
    code = f"""
import sys
sys.modules[{package!r}] = None
from grammarbt.bt import leaves
from grammarbt.errors import DomainError
from grammarbt_gymnasium.domain import GymnasiumDomain
from grammarbt_gymnasium.parameters import GymnasiumParameters
try:
    GymnasiumDomain(GymnasiumParameters(env={env!r}))
except DomainError as error:
    print(error)
"""
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert hint in printed
    assert printed.count("\n") == 1


def test_a_wrong_option_is_told_in_one_line():
    with pytest.raises(DomainError, match=r"CartPole-v1 does not start: TypeError.*no_such") as caught:
        environment.make_environment(GymnasiumParameters(options="no_such=1"))
    assert caught.value.hint


def test_an_unknown_idle_action_is_told_with_the_nearest():
    with pytest.raises(DomainError, match="did you mean 'push left'"):
        domain(idle="push lef")


def test_options_are_read_as_what_they_look_like():
    assert read_options("is_slippery=false, map_name=8x8,n=3,p=0.5,x=null") == {
        "is_slippery": False,
        "map_name": "8x8",
        "n": 3,
        "p": 0.5,
        "x": None,
    }
    assert read_options("") == {}


@pytest.mark.parametrize("text", ["is_slippery", "=3", "a b=3"])
def test_options_of_another_form_are_refused(text):
    with pytest.raises(ParameterError, match="options"):
        read_options(text)


@pytest.mark.parametrize(
    "wrong",
    [{"thresholds": 0}, {"max_steps": 0}, {"rollout": 1}, {"spacing": "even"}, {"env": 3}, {"env": ""}],
    ids=str,
)
def test_parameters_out_of_range_are_refused(wrong):
    with pytest.raises((ValueError, TypeError), match=next(iter(wrong))):
        GymnasiumParameters(**wrong)
