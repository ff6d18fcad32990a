"""Observations that are codes or pictures, put into words."""

import numpy as np
import pytest
from gymnasium_worlds import domain

from grammarbt_gymnasium.minigrid import OBJECTS, minigrid_view
from grammarbt_gymnasium.scenes import in_words
from grammarbt_gymnasium.views import view_of


def words(view, observation):
    values = view.read(observation)
    return {feature.name: in_words(feature, value) for feature, value in zip(view.features, values, strict=True)}


def picture(*things, carrying="empty"):
    """A view of 7 × 7 cells; each thing is (name, steps ahead, steps to the right) and maybe its state."""
    image = np.zeros((7, 7, 3), dtype=np.uint8)
    image[:, :, 0] = OBJECTS.index("empty")
    for name, ahead, right, *state in things:
        image[3 + right, 6 - ahead] = (OBJECTS.index(name), 0, *(state or [0]))
    image[3, 6, 0] = OBJECTS.index(carrying)
    return {"image": image, "direction": 1, "mission": "go"}


def test_minigrid_says_what_is_next_to_the_robot():
    seen = words(minigrid_view(), picture(("wall", 1, 0), ("lava", 0, -1), ("goal", 0, 1)))
    assert (seen["front"], seen["left"], seen["right"]) == ("wall", "lava", "goal")
    assert seen["heading"] == "south"


def test_minigrid_tells_an_open_door_from_a_closed_one():
    assert words(minigrid_view(), picture(("door", 1, 0, 0)))["front"] == "open door"
    assert words(minigrid_view(), picture(("door", 1, 0, 1)))["front"] == "door"


def test_minigrid_says_what_is_carried():
    assert words(minigrid_view(), picture(carrying="key"))["carrying"] == "key"
    assert words(minigrid_view(), picture())["carrying"] == "nothing"


def test_what_is_carried_is_not_sought_any_more():
    assert words(minigrid_view(), picture(carrying="key"))["key"] == "nowhere"


@pytest.mark.parametrize(
    ("ahead", "right", "side"), [(3, 0, "ahead"), (2, -1, "left"), (0, 2, "right"), (6, 3, "right")]
)
def test_minigrid_says_on_which_side_a_thing_is(ahead, right, side):
    assert words(minigrid_view(), picture(("goal", ahead, right)))["goal"] == side


def test_of_two_things_of_a_kind_the_nearer_counts():
    assert words(minigrid_view(), picture(("ball", 1, 2), ("ball", 1, -1)))["ball"] == "left"


def test_minigrids_numbers_of_objects_are_as_the_package_has_them():
    constants = pytest.importorskip("minigrid.core.constants")
    assert {name: number for number, name in enumerate(OBJECTS)} == constants.OBJECT_TO_IDX
    assert constants.STATE_TO_IDX["open"] == 0


def test_minigrids_own_observations_agree_with_its_grid():
    environment = domain("MiniGrid-DoorKey-5x5-v0").environment
    view, world = view_of(environment), environment.env.unwrapped
    for seed in range(10):
        observation, _ = environment.env.reset(seed=seed)
        ahead = world.grid.get(*world.front_pos)
        assert words(view, observation)["front"] == ("nothing" if ahead is None else ahead.type)


@pytest.mark.parametrize("env", ["FrozenLake-v1", "CliffWalking-v1"])
def test_a_cell_is_its_row_and_column(env):
    environment = domain(env).environment
    view = view_of(environment)
    rows, columns = (len(feature.labels) for feature in view.features)
    states = range(int(environment.env.observation_space.n))
    assert [tuple(view.read(state)) for state in states] == [(r, c) for r in range(rows) for c in range(columns)]


def test_a_larger_lake_has_more_rows():
    assert len(view_of(domain("FrozenLake-v1", options="map_name=8x8").environment).features[0].labels) == 8


def test_the_taxi_knows_the_way_to_its_passenger_and_then_to_the_destination():
    environment = domain("Taxi-v4").environment
    world, view = environment.env.unwrapped, view_of(environment)
    waiting = words(view, world.encode(2, 2, 0, 3))
    assert (waiting["passenger"], waiting["destination"], waiting["at target"]) == ("red", "blue", "no")
    assert [waiting[f"target {way}"] for way in ("north", "south", "east", "west")] == ["yes", "no", "no", "yes"]
    riding = words(view, world.encode(4, 3, 4, 3))
    assert (riding["passenger"], riding["at target"]) == ("taxi", "yes")


def test_the_taxis_walls_are_where_it_cannot_drive():
    environment = domain("Taxi-v4").environment
    world, view = environment.env.unwrapped, view_of(environment)
    for row in range(5):
        for column in range(5):
            state = world.encode(row, column, 0, 1)
            for direction, action in (("east", 2), ("west", 3)):
                stays = world.P[state][action][0][1] == state
                assert (words(view, state)[f"wall {direction}"] == "yes") == stays
