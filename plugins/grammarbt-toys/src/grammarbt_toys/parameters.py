"""The numbers of the toy worlds."""

from __future__ import annotations

from attrs import field, frozen
from attrs.validators import ge, instance_of, le


@frozen
class TaskSelectionParameters:
    """Parameters of task selection.

    Raises:
        ValueError: a number is out of range.
    """

    conditions: int = field(
        default=3,
        validator=[instance_of(int), ge(1), le(8)],  # 8 conditions have 40,321 actions
        metadata={"help": "conditions besides c0; N of them have the actions a0 to aN!"},
    )


@frozen
class AntParameters:
    """Parameters of the artificial ant.

    Raises:
        ValueError: a number is out of range.
    """

    steps: int = field(
        default=600,
        validator=[instance_of(int), ge(1), le(1_000_000)],
        metadata={"help": "steps of an episode; 400 and 615 are also in use"},
    )


@frozen
class ForagingParameters:
    """Parameters of swarm foraging.

    Raises:
        ValueError: a number is out of range.
    """

    size: int = field(
        default=40, validator=[instance_of(int), ge(8), le(1_000)], metadata={"help": "cells of the area, to a side"}
    )
    robots: int = field(
        default=10, validator=[instance_of(int), ge(1), le(1_000)], metadata={"help": "robots of the swarm"}
    )
    sites: int = field(default=2, validator=[instance_of(int), ge(1), le(100)], metadata={"help": "sites with food"})
    food: int = field(
        default=20, validator=[instance_of(int), ge(1), le(10_000)], metadata={"help": "pieces of food at each site"}
    )
    sight: int = field(
        default=3, validator=[instance_of(int), ge(1), le(100)], metadata={"help": "cells that a robot sees"}
    )
    steps: int = field(
        default=300, validator=[instance_of(int), ge(1), le(1_000_000)], metadata={"help": "steps of an episode"}
    )


@frozen
class PlatformerParameters:
    """Parameters of the platform game.

    Raises:
        ValueError: a number is out of range.
    """

    columns: int = field(
        default=100, validator=[instance_of(int), ge(2), le(10_000)], metadata={"help": "columns of a level"}
    )
    steps: int = field(
        default=120, validator=[instance_of(int), ge(1), le(1_000_000)], metadata={"help": "steps of an episode"}
    )
