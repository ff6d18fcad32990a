"""What changes in an episode, as NumPy records: compiled functions hand a record on as one pointer."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Records: TypeAlias = NDArray[np.void]

MAX_CUBES = 3

STRETCHED, TUCKED, AT_PICK, AT_PLACE = range(4)
"""Postures of the arm."""
NOTHING = -1
"""In the place of a cube."""
FRESH = -1
"""In the place of the answer of an action node that is to begin."""

STATE = np.dtype(
    [
        ("key", np.uint64),  # what makes the scenario's chance its own
        ("run", np.int64),  # which of the episode's runs this is
        ("stochastic", np.int64),  # whether actions can go wrong
        ("tick", np.int64),  # ticks begun
        ("acts", np.int64),  # actions done
        ("time", np.float64),  # seconds they took
        ("cubes", np.int64),  # how many cubes there are; further rows of the tables by cube mean nothing
        ("start", np.float64, (MAX_CUBES, 3)),  # where each cube starts, in metres
        ("place", np.int64),  # where the robot is
        ("pose", np.float64, (2,)),  # the same in metres
        ("estimate", np.float64, (2,)),  # where the robot believes to be
        ("localised", np.int64),  # whether it knows
        ("head_up", np.int64),  # else it is down
        ("arm", np.int64),  # its posture
        ("held", np.int64),  # the cube held, or NOTHING
        ("visited", np.int64, (3,)),  # whether it tried to pick at each pick table
        ("moving", np.int64),  # whether a move has begun since one was last done
        ("handling", np.int64),  # whether tucking, picking or placing has begun since one was last done
        ("cube", np.float64, (MAX_CUBES, 3)),  # where each cube is
        ("error", np.float64),  # distance from estimate to pose, by the last update like the next two
        ("to_goal", np.float64, (MAX_CUBES,)),  # distance from each cube to its goal
        ("to_robot", np.float64, (MAX_CUBES,)),  # horizontal distance from each cube to the robot
    ],
    align=True,
)
"""The state of a run; lengths in metres, times in seconds."""

MEMORY = np.dtype([("status", np.int64), ("running", np.int64)], align=True)
"""What an action node remembers: its last answer, or FRESH, and the last tick in which that was RUNNING."""

Record: TypeAlias = Any
"""One record: NumPy's type knows no fields by name."""
