"""A curve as a row of letters."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

from grammarbt.report.thinning import thinned

_BARS = "▁▂▃▄▅▆▇█"


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
    scale = (len(_BARS) - 1) / (high - low) if high > low else 0.0
    return "".join(_BARS[round((value - low) * scale)] for value in shown)
