"""Curves as vector pictures, drawn with matplotlib."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from grammarbt.errors import PluginError
from grammarbt.report.curves import Point, value_at
from grammarbt.report.statistics import LEVEL

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes

    from grammarbt.report.comparison import Entrant

_WIDTH, _HEIGHT = 4.6, 3.2
"""Inches per panel."""


def save_curves(entrants: Sequence[Entrant], path: Path) -> None:
    """A panel per domain, a line per searcher: mean over seeds, with its bootstrap interval; the reference dashed.

    The file's ending decides the format: svg, pdf or png.

    Raises:
        PluginError: matplotlib is not installed.
    """
    try:
        import matplotlib as mpl  # noqa: PLC0415 - an extra
        from matplotlib.figure import Figure  # noqa: PLC0415
    except ImportError:
        raise PluginError("curves are drawn with matplotlib", "pip install 'grammarbt[plots]'") from None
    mpl.rcParams.update({"svg.fonttype": "none", "pdf.fonttype": 42, "svg.hashsalt": "grammarbt"})
    domains = list(dict.fromkeys(entrant.domain for entrant in entrants))
    figure = Figure(figsize=(_WIDTH * len(domains), _HEIGHT), layout="constrained")
    panels = figure.subplots(1, len(domains), squeeze=False)[0]
    for panel, domain in zip(panels, domains, strict=True):
        _draw(panel, domain, [entrant for entrant in entrants if entrant.domain == domain and entrant.curves])
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)


def band(curves: Mapping[int, Sequence[Point]]) -> tuple[list[int], list[float], list[float], list[float]]:
    """Episodes, and there mean, low and high of the seeds' values; from where every seed has an incumbent."""
    rng = np.random.default_rng(0)
    budgets = sorted({point.episodes for points in curves.values() for point in points})
    at: list[int] = []
    found: list[tuple[float, float, float]] = []
    for budget in budgets:
        values = [value_at(points, budget) for points in curves.values()]
        known = np.array([value for value in values if value is not None])
        if len(known) == len(values):
            means = known[rng.integers(len(known), size=(2_000, len(known)))].mean(axis=1)
            low, high = np.quantile(means, [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
            at.append(budget)
            found.append((float(known.mean()), float(low), float(high)))
    means_, lows, highs = ([each[place] for each in found] for place in range(3))
    return at, means_, lows, highs


def _draw(panel: Axes, domain: str, entrants: Sequence[Entrant]) -> None:
    for entrant in entrants:
        at, means, lows, highs = band(entrant.curves)
        (line,) = panel.plot(at, means, label=entrant.searcher, linewidth=1.4)
        panel.fill_between(at, lows, highs, color=line.get_color(), alpha=0.2, linewidth=0)
    references = [run.reference.mean for each in entrants for run in each.runs.values() if run.reference]
    if references:
        panel.axhline(float(np.mean(references)), linestyle="--", linewidth=1, color="0.4", label="reference")
    panel.set_xscale("log")
    panel.set_xlabel("episodes")
    panel.set_ylabel("return on fresh worlds")
    panel.set_title(domain)
    panel.legend(frameon=False, fontsize="small")
