"""Pictures show the worlds as they are."""

from math import cos, sin

import gymnasium
import numpy as np
import pytest
from gymnasium import spaces
from gymnasium_worlds import domain, policy

from grammarbt_gymnasium.rooms import COLOURS, LOOKS, STATES
from grammarbt_gymnasium.scenes import scene_of
from grammarbt_gymnasium.views import view_of

PICK_UP, DROP, TOGGLE = 3, 4, 5
LANDER = "LunarLander-v3"


def marks_of(of, observation=None):
    """By name, what is drawn of the world as it is now."""
    environment = of.environment
    view = view_of(environment)
    values = view.read(observation) if observation is not None else ()
    return {mark.name: mark for mark in scene_of(environment, view).marks(values)}


@pytest.fixture
def rooms():
    """A world with a key and a locked door, and a function that puts the robot in front of either."""
    of = domain("MiniGrid-DoorKey-6x6-v0")
    of.environment.env.reset(seed=4)
    world = of.environment.env.unwrapped

    def face(kind):
        (at,) = (cell for cell in cells(world) if getattr(world.grid.get(*cell), "type", "") == kind)
        for heading, (dx, dy) in enumerate(((1, 0), (0, 1), (-1, 0), (0, -1))):
            beside = (at[0] - dx, at[1] - dy)
            if world.grid.get(*beside) is None:
                world.agent_pos, world.agent_dir = beside, heading
        return at

    return of, face


def cells(world):
    return [(column, row) for column in range(world.width) for row in range(world.height)]


@pytest.mark.parametrize(
    "env", ["MiniGrid-DoorKey-8x8-v0", "MiniGrid-LavaCrossingS9N1-v0", "MiniGrid-MultiRoom-N2-S4-v0", "BabyAI-GoTo-v0"]
)
def test_every_cell_is_drawn_as_the_world_has_it(env):
    of = domain(env)
    of.environment.env.reset(seed=1)
    world, marks = of.environment.env.unwrapped, marks_of(of)
    for cell in cells(world):
        mark, thing = marks[f"thing {cell}"], world.grid.get(*cell)
        assert (mark.x, mark.y) == (cell[0] + 0.5, world.height - cell[1] - 0.5)
        if thing is None:
            assert mark.shade == 0
        else:
            assert (mark.shape, mark.role, mark.size) == LOOKS[thing.type]
            assert mark.label.endswith(f"{thing.color} {thing.type}") == (thing.type in {"door", "key", "ball", "box"})


@pytest.mark.parametrize("heading", range(4))
def test_the_robot_points_to_where_it_looks(rooms, heading):
    world = rooms[0].environment.env.unwrapped
    world.agent_dir = heading
    angle = marks_of(rooms[0])["robot"].angle
    assert np.allclose((cos(angle), sin(angle)), (world.dir_vec[0], -world.dir_vec[1]))


def test_what_is_picked_up_leaves_its_cell_and_is_carried(rooms):
    of, face = rooms
    cell = face("key")
    of.environment.env.step(PICK_UP)
    assert marks_of(of)["robot"].label == "carries yellow key"
    assert marks_of(of)[f"thing {cell}"].shade == 0
    of.environment.env.step(DROP)
    assert marks_of(of)["robot"].label == ""
    assert marks_of(of)[f"thing {cell}"].label == "yellow key"


def test_a_door_that_is_opened_says_so_and_fades(rooms):
    of, face = rooms
    face("key")
    of.environment.env.step(PICK_UP)
    cell = face("door")
    locked = marks_of(of)[f"thing {cell}"]
    of.environment.env.step(TOGGLE)
    ajar = marks_of(of)[f"thing {cell}"]
    assert (locked.label, ajar.label) == ("locked yellow door", "open yellow door")
    assert ajar.shade < locked.shade


def test_a_step_in_a_room_draws_the_robot_alone():
    of = domain("MiniGrid-Empty-8x8-v0")
    frames = of.episode(policy(of, "[turn left]"), 0).frames
    assert {tuple(mark.name for mark in frame.changes) for frame in frames} == {("robot",)}


def test_colours_and_states_are_as_minigrid_numbers_them():
    constants = pytest.importorskip("minigrid.core.constants")
    assert list(COLOURS) == sorted(constants.COLOR_TO_IDX, key=constants.COLOR_TO_IDX.get)
    assert list(STATES) == sorted(constants.STATE_TO_IDX, key=constants.STATE_TO_IDX.get)


class Camera(gymnasium.Env):
    """Observes as MiniGrid does, and has no grid."""

    action_space = spaces.Discrete(2)
    observation_space = spaces.Dict({"image": spaces.Box(0, 9, (7, 7, 3), np.uint8), "direction": spaces.Discrete(4)})

    def reset(self, *, seed=None, options=None):
        return {"image": np.zeros((7, 7, 3), np.uint8), "direction": 0}, {}

    def step(self, action):
        return self.reset()[0], 0.0, True, False, {}


gymnasium.register("Camera-v0", Camera)


def test_an_environment_that_only_observes_like_minigrid_is_put_into_words():
    of = domain("Camera-v0")
    episode = of.episode(policy(of, "[action 0]"), 0)
    assert {mark.shape for mark in episode.marks} == {"text"}
    assert "front: wall" in [mark.label for mark in episode.marks]


def test_the_lander_is_where_the_simulator_has_it():
    environment = domain(LANDER).environment
    world = environment.env.unwrapped
    environment.env.reset(seed=3)
    for _ in range(60):
        observation, *_ = environment.env.step(1)
    marks = marks_of(domain(LANDER), observation)
    body, middle = world.lander, (world.helipad_x1 + world.helipad_x2) / 2
    assert (marks["lander"].x, marks["lander"].y) == pytest.approx(
        (body.position.x - middle, body.position.y - world.helipad_y), abs=1e-4
    )
    assert marks["lander"].angle == pytest.approx(body.angle, abs=1e-4)
    for leg in world.legs:
        feet = [(marks[name].to_x, marks[name].to_y) for name in ("left leg", "right leg")]
        x, y = leg.position.x - middle, leg.position.y - world.helipad_y
        assert min(np.hypot(foot[0] - x, foot[1] - y) for foot in feet) < 0.5


def test_the_pad_is_level_with_the_terrain_on_both_sides():
    environment = domain(LANDER).environment
    observation, _ = environment.env.reset(seed=5)
    world, marks = environment.env.unwrapped, marks_of(domain(LANDER), observation)
    pad = marks["pad"]
    assert pad.to_x - pad.x == world.helipad_x2 - world.helipad_x1
    terrain = [mark for name, mark in marks.items() if name.startswith("terrain")]
    assert (terrain[0].x, terrain[-1].to_x) == (-10, 10)
    under = [mark for mark in terrain if mark.x >= pad.x and mark.to_x <= pad.to_x]
    assert len(under) == 2
    assert [mark.y for mark in under] == pytest.approx([0, 0], abs=0.05)


def test_a_leg_that_touches_the_ground_looks_otherwise():
    of = domain(LANDER)
    episode = of.episode(policy(of, of.references[0].tree), 1)
    roles = [picture["left leg"].role for picture in episode.pictures()]
    assert roles[0] == "object"
    assert "goal" in roles
