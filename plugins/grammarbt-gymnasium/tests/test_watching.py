"""What is shown of an episode, and references as they were measured."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from gymnasium_worlds import domain, policy, returns

from grammarbt.domain import Watchable
from grammarbt_gymnasium.scenes import SCENES

PLAYTHROUGHS = runpy.run_path(str(Path(__file__).with_name("record_playthroughs.py")))["PLAYTHROUGHS"]
IDS = {name: f"{name}-v{version}" for name, version in zip(SCENES, (1, 0, 1, 3, 1, 1, 4), strict=True)}
ROOMS = ["MiniGrid-DoorKey-5x5-v0", "MiniGrid-LavaGapS6-v0", "MiniGrid-MultiRoom-N2-S4-v0", "BabyAI-GoToObj-v0"]


@pytest.mark.parametrize("env", [*IDS.values(), "Blackjack-v1", *ROOMS])
def test_a_picture_has_each_mark_once_and_keeps_inside_its_box(env):
    of = domain(env, max_steps=30)
    assert isinstance(of, Watchable)
    episode = of.episode(policy(of, f"[{of.vocabulary.groups[1].name}]"), 5)
    names = [mark.name for mark in episode.marks]
    assert len(set(names)) == len(names)
    left, bottom, right, top = episode.box
    for mark in (*episode.marks, *(mark for frame in episode.frames for mark in frame.changes)):
        assert left <= mark.x <= right
        assert bottom <= mark.y <= top
        assert mark.name in names


@pytest.mark.parametrize("env", [IDS["CartPole"], IDS["FrozenLake"]])
def test_only_what_moves_is_drawn_anew(env):
    of = domain(env)
    moving = {"CartPole-v1": {"cart", "pole"}, "FrozenLake-v1": {"walker"}}[env]
    frames = of.episode(policy(of, f"[{of.vocabulary.groups[1].name}]"), 2).frames
    assert {mark.name for frame in frames for mark in frame.changes} == moving


@pytest.mark.parametrize("world", PLAYTHROUGHS.worlds)
def test_the_reference_goes_through_the_recorded_steps(world):
    assert PLAYTHROUGHS.told(world) == PLAYTHROUGHS.recorded(world)


@pytest.mark.parametrize(
    ("env", "low", "high"), [("CartPole-v1", 500, 500), ("MountainCar-v0", -112, -103), ("Acrobot-v1", -90, -75)]
)
def test_the_references_are_worth_what_the_guide_says(env, low, high):
    of = domain(env)
    mean = np.mean(returns(of, of.references[0].tree, range(1_000, 1_040)))
    assert low <= mean <= high


def test_the_lake_is_slippery_and_still_the_same_for_the_same_scenario():
    of = domain("FrozenLake-v1")
    tree = "?( →( (row above(value=1)) [go right] ) [go down] )"
    once, again = (returns(of, tree, range(200)) for _ in range(2))
    assert once == again
    assert set(once) == {0.0, 1.0}
