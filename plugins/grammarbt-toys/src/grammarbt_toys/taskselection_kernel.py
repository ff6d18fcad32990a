"""Task selection, compiled: what a tick does in every truth assignment."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grammarbt_toys.program import FAILURE, RUNNING, SUCCESS, Program, cached, compiled


@cached
def first_actions(program: Program, conditions: int, actions: int) -> NDArray[np.int64]:
    """Tick once in every truth assignment of the conditions.

    Args:
        program: over leaves of which the first are the actions, the others the conditions.
        conditions: how many conditions there are.
        actions: how many actions there are.

    Returns:
        (2^conditions,) by assignment the first action that was ticked, or -1; bit i of an assignment says whether
        condition i holds.
    """
    first = np.empty(1 << conditions, dtype=np.int64)
    for assignment in range(first.size):
        first[assignment] = _first_action(program, actions, assignment)
    return first


@compiled
def _first_action(program: Program, actions: int, assignment: int) -> int:
    """Actions stay running; a tick goes on after one only in a parallel node."""
    first, at = -1, 0
    while at >= 0:
        leaf = int(program.leaf[at])
        program.ticks[program.occurrence[at]] += 1
        if leaf >= actions:
            status = SUCCESS if assignment >> (leaf - actions) & 1 else FAILURE
        else:
            status = RUNNING
            if first < 0:
                first = leaf
        at = int(program.follow[at, status])
    return first
