"""Statistics for comparing searchers over seeds, as recommended for few runs.

Interquartile mean with bootstrap interval and probability of improvement: Agarwal et al., "Deep Reinforcement Learning at
the Edge of the Statistical Precipice" (NeurIPS 2021). Holm's step-down correction: Scandinavian Journal of Statistics 6
(1979). Wilson's interval for shares: JASA 22 (1927).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from math import sqrt
from typing import TypeAlias

import numpy as np
from attrs import frozen
from numpy.typing import NDArray

Values: TypeAlias = NDArray[np.float64]
Estimator: TypeAlias = Callable[[Values], float]

LEVEL = 0.95
NORMAL_95 = 1.959963984540054
"""Standard errors to either side that make a 95 % interval of a mean."""

_RESAMPLES = 10_000
_BLOCK = 2_000_000
"""Numbers drawn at once, so that many seeds do not fill the memory."""
_MOST_EXACT = 12
"""Pairs up to which a permutation test tries every sign."""


@frozen
class Interval:
    """An estimate, with the ends of its 95 % interval."""

    value: float
    low: float
    high: float


def interquartile_mean(values: Values) -> float:
    """Mean of the middle half; a quarter of the weight is cut off at each end, in parts of a value if need be."""
    ordered = np.sort(values)
    n = len(ordered)
    ends = np.arange(n + 1) / n
    weights = np.clip(np.minimum(ends[1:], 0.75) - np.maximum(ends[:-1], 0.25), 0.0, None)
    return float(ordered @ weights / weights.sum())


def mean(values: Values) -> float:
    """The plain mean."""
    return float(values.mean())


def bootstrap(values: Sequence[float], estimator: Estimator, rng: np.random.Generator) -> Interval:
    """An estimate with the percentile interval of its bootstrap distribution.

    Args:
        values: one per seed.
        estimator: what of them.
        rng: draws the samples.
    """
    data = np.asarray(values, dtype=np.float64)
    if len(data) == 0:
        return Interval(float("nan"), float("nan"), float("nan"))
    picks = rng.integers(len(data), size=(min(_RESAMPLES, max(1, _BLOCK // len(data))), len(data)))
    return _percentile_interval(estimator(data), [estimator(data[pick]) for pick in picks])


def share(hits: int, n: int) -> Interval:
    """A share of n runs, with Wilson's interval."""
    if n == 0:
        return Interval(float("nan"), 0.0, 1.0)
    p = hits / n
    centre = (p + NORMAL_95**2 / (2 * n)) / (1 + NORMAL_95**2 / n)
    spread = NORMAL_95 / (1 + NORMAL_95**2 / n) * sqrt(p * (1 - p) / n + NORMAL_95**2 / (4 * n**2))
    return Interval(p, max(0.0, centre - spread), min(1.0, centre + spread))


def probability_of_improvement(ours: Sequence[float], theirs: Sequence[float], rng: np.random.Generator) -> Interval:
    """How likely a run of ours beats one of theirs; ties count half. Both are resampled for the interval."""
    a, b = np.asarray(ours, dtype=np.float64), np.asarray(theirs, dtype=np.float64)
    beats = (a[:, None] > b[None, :]) + 0.5 * (a[:, None] == b[None, :])
    rows = rng.integers(len(a), size=(_RESAMPLES // 5, len(a)))
    columns = rng.integers(len(b), size=(_RESAMPLES // 5, len(b)))
    found = [float(beats[np.ix_(row, column)].mean()) for row, column in zip(rows, columns, strict=True)]
    return _percentile_interval(float(beats.mean()), found)


def mean_ranks(table: Values) -> Values:
    """Mean rank of each column of a (seeds, searchers) table, 1 is best; ties share their ranks."""
    above = (table[:, None, :] > table[:, :, None]).sum(axis=2)
    equal = (table[:, None, :] == table[:, :, None]).sum(axis=2)
    ranks: Values = (above + (equal + 1) / 2.0).mean(axis=0)
    return ranks


def paired_p_value(ours: Sequence[float], theirs: Sequence[float], rng: np.random.Generator) -> float:
    """Two-sided permutation test of equal means over pairs: the signs of the differences are as good as any others.

    Exact up to twelve pairs, by random signs beyond.
    """
    differences = np.asarray(ours, dtype=np.float64) - np.asarray(theirs, dtype=np.float64)
    n = len(differences)
    if n <= _MOST_EXACT:
        signs = np.array(list(product((-1.0, 1.0), repeat=n)))
        sums = np.abs(signs @ differences)
        return float((sums >= abs(differences.sum()) - 1e-12).mean())
    signs = rng.choice((-1.0, 1.0), size=(_RESAMPLES, n))
    hits = int((np.abs(signs @ differences) >= abs(differences.sum()) - 1e-12).sum())
    return (hits + 1) / (_RESAMPLES + 1)


def holm(p_values: Sequence[float]) -> list[float]:
    """Holm's adjusted p-values, in the order given."""
    order = sorted(range(len(p_values)), key=lambda at: p_values[at])
    adjusted = [0.0] * len(p_values)
    highest = 0.0
    for place, at in enumerate(order):
        highest = max(highest, min(1.0, (len(p_values) - place) * p_values[at]))
        adjusted[at] = highest
    return adjusted


def _percentile_interval(value: float, resampled: Sequence[float]) -> Interval:
    low, high = np.quantile(resampled, [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
    return Interval(value, float(low), float(high))
