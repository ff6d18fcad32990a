"""Numbers that stand for vertices, things and decisions, as compiled functions hand them on."""

from __future__ import annotations

import numpy as np

from grammarbt_marine import layouts, state


def numpy_integers(*numbers: int) -> tuple[int, ...]:
    """The numbers as NumPy's: numba compiles a function anew for each of Python's that it is called with."""
    return tuple(np.array(numbers, dtype=np.int64))


START, DROP_OFF = numpy_integers(layouts.START, layouts.DROP_OFF)
NOTHING, TARGET, MINE, OBJECT = numpy_integers(state.NOTHING, state.TARGET, state.MINE, state.OBJECT)
PLACING, SENSING, WALKING = numpy_integers(0, 1, 2)
"""What chance decides."""
