"""Which environment, and how its observations become conditions."""

from __future__ import annotations

from typing import Literal

from attrs import field, frozen
from attrs.validators import ge, in_, instance_of, le, min_len, optional

Spacing = Literal["quantiles", "grid"]


@frozen
class GymnasiumParameters:
    """Parameters of the domain.

    Raises:
        ValueError: a number is out of range.
    """

    env: str = field(
        default="CartPole-v1",
        validator=[instance_of(str), min_len(1)],
        metadata={"help": "the environment's id, as gymnasium.make takes it; module:id imports the module first"},
    )
    options: str = field(
        default="",
        validator=instance_of(str),
        metadata={"help": "keyword arguments of the environment: is_slippery=false,map_name=8x8"},
    )
    max_steps: int | None = field(
        default=None,
        validator=optional([instance_of(int), ge(1)]),
        metadata={"help": "steps of the longest episode; unset: the environment's own limit, or 1000 if it has none"},
    )
    idle: str | None = field(
        default=None,
        validator=optional(instance_of(str)),
        metadata={"help": "action taken in a tick that ran none; unset: the one that does nothing, or else the first"},
    )
    thresholds: int = field(
        default=9,
        validator=[instance_of(int), ge(1), le(99)],
        metadata={"help": "thresholds that each number of the observation is compared with"},
    )
    spacing: Spacing = field(
        default="quantiles",
        validator=in_(("quantiles", "grid")),
        metadata={"help": "quantiles: of a random roll-out; grid: equal steps between the bounds of the observation"},
    )
    rollout: int = field(
        default=5_000,
        validator=[instance_of(int), ge(100), le(10_000_000)],
        metadata={"help": "steps of the random roll-out that thresholds are read from"},
    )
