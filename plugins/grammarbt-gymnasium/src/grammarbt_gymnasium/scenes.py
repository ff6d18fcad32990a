"""Pictures of the worlds that are known, drawn from what is observed; of any other world, the observation in words."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise
from math import atan2, cos, pi, sin
from typing import TYPE_CHECKING, Any

from grammarbt.domain import Mark
from grammarbt_gymnasium.features import Choice, Feature, Flag, Values
from grammarbt_gymnasium.grids import cliff_walking_scene, frozen_lake_scene, taxi_scene
from grammarbt_gymnasium.lander import lander_scene
from grammarbt_gymnasium.minigrid import is_minigrid
from grammarbt_gymnasium.rooms import rooms_scene
from grammarbt_gymnasium.scene import Scene, line

if TYPE_CHECKING:
    from grammarbt_gymnasium.environment import Environment
    from grammarbt_gymnasium.features import View


def scene_of(environment: Environment, view: View) -> Scene:
    """How to draw the environment."""
    world = environment.env.unwrapped
    if environment.name in SCENES:
        return SCENES[environment.name](world)
    has_rooms = is_minigrid(environment.env.observation_space) and hasattr(world, "grid")
    return rooms_scene(world) if has_rooms else words_scene(view)


def cart_pole_scene(_: Any) -> Scene:  # noqa: ANN401 - gymnasium's worlds share no useful type
    """A cart on its track, in metres, and the pole on it; the posts are where an episode ends."""

    def marks(values: Values) -> Iterator[Mark]:
        x, _, angle, _ = values
        yield line("track", "ground", (-2.4, 0.0), (2.4, 0.0), 0.03)
        yield Mark("left post", "square", "hazard", -2.4, 0.0, 0.12)
        yield Mark("right post", "square", "hazard", 2.4, 0.0, 0.12)
        yield Mark("cart", "square", "robot", x, 0.0, 0.3)
        yield line("pole", "object", (x, 0.15), (x + sin(angle), 0.15 + cos(angle)), 0.06)

    return Scene((-2.6, -0.5, 2.6, 1.6), marks)


HILL_POINTS = 36


def mountain_car_scene(_: Any) -> Scene:  # noqa: ANN401 - as above
    """The car in its valley, with the flag on the right hill; heights are those the environment itself draws."""

    def height(x: float) -> float:
        return 0.45 * sin(3 * x) + 0.55

    def marks(values: Values) -> Iterator[Mark]:
        points = [(x, height(x)) for x in (-1.2 + 1.8 * number / HILL_POINTS for number in range(HILL_POINTS + 1))]
        for number, (start, end) in enumerate(pairwise(points)):
            yield line(f"hill {number}", "ground", start, end, 0.015)
        yield Mark("flag", "triangle", "goal", 0.5, height(0.5) + 0.06, 0.08, angle=pi / 2)
        yield Mark("car", "circle", "robot", values[0], height(values[0]) + 0.03, 0.08)

    return Scene((-1.3, 0.0, 0.7, 1.2), marks)


def acrobot_scene(_: Any) -> Scene:  # noqa: ANN401 - as above
    """Two links of length 1 that hang from the origin, and the height that the free end is to reach."""

    def marks(values: Values) -> Iterator[Mark]:
        first = atan2(values[1], values[0])
        second = first + atan2(values[3], values[2])
        joint = (sin(first), -cos(first))
        end = (joint[0] + sin(second), joint[1] - cos(second))
        yield line("height", "goal", (-2.2, 1.0), (2.2, 1.0), 0.02)
        yield line("upper link", "robot", (0.0, 0.0), joint, 0.12)
        yield line("lower link", "robot", joint, end, 0.12)
        yield Mark("joint", "circle", "object", *joint, 0.2)

    return Scene((-2.2, -2.2, 2.2, 2.2), marks)


def words_scene(view: View) -> Scene:
    """One line of text per feature."""
    rows = len(view.features)

    def marks(values: Values) -> Iterator[Mark]:
        for row, (feature, value) in enumerate(zip(view.features, values, strict=True)):
            text = f"{feature.name}: {in_words(feature, value)}"
            yield Mark(feature.name, "text", "note", 0.0, float(rows - row), 0.7, label=text)

    return Scene((0.0, 0.0, 20.0, rows + 1.0), marks)


def in_words(feature: Feature, value: float) -> str:
    """A feature's value for people."""
    if isinstance(feature, Choice):
        return feature.labels[int(value)]
    if isinstance(feature, Flag):
        return "yes" if value else "no"
    return f"{value:.4g}"


SCENES: dict[str, Callable[[Any], Scene]] = {
    "CartPole": cart_pole_scene,
    "MountainCar": mountain_car_scene,
    "Acrobot": acrobot_scene,
    "LunarLander": lander_scene,
    "FrozenLake": frozen_lake_scene,
    "CliffWalking": cliff_walking_scene,
    "Taxi": taxi_scene,
}
