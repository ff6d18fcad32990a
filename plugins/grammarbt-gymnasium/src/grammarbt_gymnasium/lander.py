"""The picture of LunarLander, in metres from the middle of its landing pad."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, sin
from typing import Any

from grammarbt.domain import Mark
from grammarbt_gymnasium.features import Values
from grammarbt_gymnasium.scene import Scene, line

WIDTH, HEIGHT = 20.0, 40 / 3
"""Of the world; the observation measures in halves of them."""
PAD, LEGS = 2.0, 0.6
"""From the middle of the pad to its ends, and from its height to the lander that stands on it."""
_FEET = {"left leg": -1, "right leg": 1}


def lander_scene(world: Any) -> Scene:  # noqa: ANN401 - gymnasium's worlds share no useful type
    """The terrain, the pad between its flags, and the lander, whose leg is a goal reached when it touches the ground."""

    def marks(values: Values) -> Iterator[Mark]:
        for number, corners in enumerate(world.sky_polys):  # the sky above a piece of terrain, its lower side first
            start, end = ((x - WIDTH / 2, float(y - world.helipad_y)) for x, y in corners[:2])
            yield line(f"terrain {number}", "ground", start, end, 0.1)
        yield line("pad", "goal", (-PAD, 0.0), (PAD, 0.0), 0.15)
        for name, x in (("left flag", -PAD), ("right flag", PAD)):
            yield Mark(name, "triangle", "goal", x, 0.5, 0.6)
        yield from _lander(values)

    return Scene((-WIDTH / 2, -HEIGHT / 4, WIDTH / 2, HEIGHT), marks)


def _lander(values: Values) -> Iterator[Mark]:
    x, y, angle = values[0] * WIDTH / 2, values[1] * HEIGHT / 2 + LEGS, values[4]
    yield Mark("lander", "square", "robot", x, y, 0.9, angle=angle)
    for (name, side), touches in zip(_FEET.items(), values[6:8], strict=True):
        hip, foot = (_turned(x, y, angle, side * aside, -down) for aside, down in ((0.35, 0.35), (0.7, LEGS)))
        yield line(name, "goal" if touches else "object", hip, foot, 0.12)


def _turned(x: float, y: float, angle: float, right: float, up: float) -> tuple[float, float]:
    """A point of the lander, which may be tilted."""
    return x + right * cos(angle) - up * sin(angle), y + right * sin(angle) + up * cos(angle)
