"""What changes in an episode: the sea, and each robot with what it believes."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from attrs import define
from numpy.typing import NDArray

from grammarbt.domain import Scenarios
from grammarbt_marine.records import Flags, Floats, Records, as_records
from grammarbt_marine.rules import Rules
from grammarbt_marine.world import Roadmap

if TYPE_CHECKING:
    from grammarbt_marine.parameters import MarineParameters

NOTHING, TARGET, MINE, OBJECT = range(-1, 3)
"""What a vertex may hold; the last three are the classes of things, in the order of every table by class."""


@define
class Robot:
    """A robot on V vertices, and what it knows of C classes.

    Attributes:
        key: what makes its chance its own.
        entry: the entry of the tree's program at which its tick goes on, or −1 before a new one.
        vertex: where it is or will arrive.
        under_way: steps until it arrives there.
        travelled: cost since it was at the surface.
        work: steps of disarming or picking up done at this vertex.
        carrying: whether it carries an object.
        belief: (C, V) how sure it is that a thing of each class is there; see `Rules`.
        visited: (V,) whether it was there.
        told: (V,) whether it knows that a target there was reported.
    """

    key: np.uint64
    entry: int
    vertex: int
    under_way: int
    travelled: float
    work: int
    carrying: bool
    belief: Floats
    visited: Flags
    told: Flags


@define
class Sea:
    """The state of the sea on V vertices, the same for the whole team.

    Attributes:
        step: steps taken.
        reward: points won.
        places: (V,) vertices in the order in which things are put there.
        content: (V,) the class of the thing at each vertex, or NOTHING.
        disarmed: (V,) whether the mine there was disarmed.
        reported: (V,) whether a target there was reported.
    """

    step: int
    reward: float
    places: NDArray[np.int64]
    content: NDArray[np.int8]
    disarmed: Flags
    reported: Flags


class World(NamedTuple):
    """An episode as one robot's leaves see and change it: four records, with the fields of these classes."""

    robot: Robot
    sea: Sea
    roadmap: Roadmap
    rules: Rules


class Episodes(NamedTuple):
    """(n,) scenarios, and as many returns to be filled in."""

    scenarios: Scenarios
    returns: Floats


class Room(NamedTuple):
    """Room for the states of an episode: a record of `Robot` for each of the team, and one of `Sea`."""

    robots: Records
    sea: Records


def make_room(parameters: MarineParameters) -> Room:
    """Room to be filled when an episode begins."""
    vertices = parameters.vertices
    robot = Robot(
        key=np.uint64(0),
        entry=0,
        vertex=0,
        under_way=0,
        travelled=0.0,
        work=0,
        carrying=False,
        belief=np.zeros((4 if parameters.sensor == "classifier" else 3, vertices)),
        visited=np.zeros(vertices, dtype=np.bool_),
        told=np.zeros(vertices, dtype=np.bool_),
    )
    sea = Sea(
        step=0,
        reward=0.0,
        places=np.zeros(vertices, dtype=np.int64),
        content=np.zeros(vertices, dtype=np.int8),
        disarmed=np.zeros(vertices, dtype=np.bool_),
        reported=np.zeros(vertices, dtype=np.bool_),
    )
    return Room(as_records([robot] * parameters.robots), as_records([sea]))
