"""Which of the published tasks, and whether actions can go wrong."""

from __future__ import annotations

from typing import Literal, TypeAlias

from attrs import field, frozen
from attrs.validators import in_, instance_of

TaskName: TypeAlias = Literal["S1", "S2", "S3"]


@frozen
class PickPlaceParameters:
    """Parameters of the pick and place domain.

    Raises:
        ValueError: there is no such task.
        TypeError: `stochastic` is not a truth value.
    """

    task: TaskName = field(
        default="S1",
        validator=in_(("S1", "S2", "S3")),
        metadata={"help": "S1: one cube on a known table; S2: one cube on any of three tables; S3: three cubes"},
    )
    stochastic: bool = field(
        default=False,
        validator=instance_of(bool),
        metadata={"help": "picking, placing, localising and moving can go wrong"},
    )
