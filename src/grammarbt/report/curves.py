"""Anytime curves: how good the incumbent was after so many episodes, measured on worlds that no search has seen."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from attrs import asdict, frozen

from grammarbt.bt import parse
from grammarbt.run.score import Validator

if TYPE_CHECKING:
    from grammarbt.report.history import History, Improvement
    from grammarbt.run.score import Score

CURVE = "curve.json"
"""The file in a run's folder that keeps its curve, which takes simulations to measure."""

_POINTS_PER_DECADE = 6


@frozen
class Point:
    """The incumbent after some episodes, and its mean return on fresh worlds."""

    episodes: int
    tree: str
    mean: float
    stderr: float


def checkpoints(budget: int) -> tuple[int, ...]:
    """Budgets at which curves are measured: six a decade, and the last."""
    found, step = [], 10 ** (1 / _POINTS_PER_DECADE)
    at = 10.0
    while at < budget:
        found.append(round(at))
        at *= step
    return (*found, budget)


def measure_curve(history: History, validator: Validator, budget: int, episodes: int) -> tuple[Point, ...]:
    """The run's curve at the checkpoints of a budget; what was measured before is read from the run's folder.

    Args:
        history: the run.
        validator: simulates on the run's validation scenarios.
        budget: the last checkpoint.
        episodes: fresh worlds per tree.
    """
    path = history.folder / CURVE
    known = _read(path, budget, episodes)
    if known is None:
        known = tuple(_measured(history.improvements, validator, checkpoints(budget), episodes))
        content = {"budget": budget, "episodes": episodes, "points": [asdict(point) for point in known]}
        with contextlib.suppress(OSError):  # what cannot be kept is measured again
            path.write_text(json.dumps(content, ensure_ascii=False) + "\n", encoding="utf-8")
    return known


def value_at(points: Sequence[Point], episodes: int) -> float | None:
    """The curve's value after so many episodes; None before the first incumbent."""
    reached = [point for point in points if point.episodes <= episodes]
    return reached[-1].mean if reached else None


def episodes_to(points: Sequence[Point], target: float) -> int | None:
    """Episodes until the curve reaches a value and does not fall below it again; None if it never does."""
    found: int | None = None
    for point in points:
        if point.mean < target:
            found = None
        elif found is None:
            found = point.episodes
    return found


def _measured(
    improvements: Sequence[Improvement], validator: Validator, budgets: Sequence[int], episodes: int
) -> list[Point]:
    scores: dict[str, Score] = {}
    points: list[Point] = []
    for budget in budgets:
        before = [improvement for improvement in improvements if improvement.episodes <= budget]
        if before:
            tree = before[-1].tree
            score = scores[tree] = scores.get(tree) or validator.score(parse(tree), episodes)
            points.append(Point(budget, tree, score.mean, score.stderr))
    return points


def _read(path: Path, budget: int, episodes: int) -> tuple[Point, ...] | None:
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if (content["budget"], content["episodes"]) != (budget, episodes):
            return None
        return tuple(Point(**point) for point in content["points"])
    except (OSError, ValueError, KeyError, TypeError):  # not measured yet, or by another version
        return None
