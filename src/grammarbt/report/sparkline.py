"""A curve as a row of letters."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from math import isfinite

from grammarbt.report.thinning import thinned

_BARS = "▁▂▃▄▅▆▇█"


def course(steps: Sequence[tuple[int, float]], until: int, width: int) -> str:
    """A value that rises in steps, drawn over episodes.

    Args:
        steps: after how many episodes it became what.
        until: episodes at the right end.
        width: letters.
    """
    if not steps:
        return ""
    first = steps[0][0]
    places = [first + (until - first) * at // max(width - 1, 1) for at in range(width)]
    episodes = [step for step, _ in steps]
    return sparkline([steps[bisect_right(episodes, place) - 1][1] for place in places], width)


def sparkline(values: Sequence[float], width: int) -> str:
    """The values from left to right, the lowest and the highest as the shortest and the longest bar.

    Args:
        values: what to show; those that are not finite are left out.
        width: letters at most.
    """
    shown = thinned([value for value in values if isfinite(value)], width)
    if not shown:
        return ""
    low, high = min(shown), max(shown)
    spread = high - low or 1.0
    return "".join(_BARS[round((value - low) / spread * (len(_BARS) - 1))] for value in shown)
