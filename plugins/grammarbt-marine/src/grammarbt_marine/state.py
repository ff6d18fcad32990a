"""What changes in an episode."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from attrs import define
from numpy.typing import NDArray

from grammarbt_marine.records import Flags, Floats, Records, as_records
from grammarbt_marine.rules import Rules
from grammarbt_marine.world import Roadmap

NOTHING, TARGET, MINE, OBJECT = range(-1, 3)
"""What a vertex may hold; the last three are the classes of things, in the order of every table by class."""


@define
class State:
    """The state of an episode on V vertices.

    Attributes:
        key: what makes the scenario's chance its own.
        step: steps taken.
        reward: points won.
        vertex: where the robot is.
        work: steps of disarming or picking up done at this vertex.
        carrying: whether the robot carries an object.
        content: (V,) the class of the thing at each vertex, or NOTHING.
        belief: (3, V) log odds that a thing of each class is there.
        visited: (V,) whether the robot was there.
        reported: (V,) whether it reported a target there.
        disarmed: (V,) whether it disarmed a mine there.
    """

    key: np.uint64
    step: int
    reward: float
    vertex: int
    work: int
    carrying: bool
    content: NDArray[np.int8]
    belief: Floats
    visited: Flags
    reported: Flags
    disarmed: Flags


class World(NamedTuple):
    """An episode as compiled code holds it: three records, with the fields of these classes."""

    state: State
    roadmap: Roadmap
    rules: Rules


def make_states(vertices: int) -> Records:
    """Room for the state of an episode: one record, to be filled when the episode begins."""
    state = State(
        key=np.uint64(0),
        step=0,
        reward=0.0,
        vertex=0,
        work=0,
        carrying=False,
        content=np.zeros(vertices, dtype=np.int8),
        belief=np.zeros((3, vertices)),
        visited=np.zeros(vertices, dtype=np.bool_),
        reported=np.zeros(vertices, dtype=np.bool_),
        disarmed=np.zeros(vertices, dtype=np.bool_),
    )
    return as_records([state])
