"""The published numbers, and what chance decides, for both simulators; lengths in metres, times in seconds."""

from __future__ import annotations

import numpy as np

PLACE_TABLE, SPAWN, ELSEWHERE = 3, 4, 5
"""Places after the pick tables 0 to 2."""
POSES = np.array([(-1.148, -6.1), (-2.32, -10.52), (-0.54, -0.545), (2.6009, -1.7615), (2.4, -11.0)])
FACING = np.array([(0.0, -1.0), (0.0, -1.0), (-1.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 0.0)])
GOAL = np.array([3.1509, -1.7615, 0.8625])
FIRST_ESTIMATE = np.array([-0.03343, -0.0321])

MAX_TICKS, MAX_FAILURES, ENOUGH_SUCCESSES = 60, 5, 2
SPEED, REACH = 0.3, 0.8
SECONDS = np.array([0.0, 0.0, 0.0, 0.0, 3.0, 12.0, 5.0, 7.0, 2.0, 2.0])
"""How long actions take, in the order of `LEAVES`; a move takes as long as its way."""
PICK_FAILS, PLACE_FAILS, LOCALISE_FAILS, DROPPED, LOST = 0.2, 0.1, 0.2, 0.05, 0.1

ESTIMATE, CUBE, OUTCOME, DROPPING, LOSING, LOST_ESTIMATE = 0, 2, 5, 6, 7, 8
"""What chance decides; coordinates count on from the first."""
