"""Runs of several searchers compared: one row per domain and searcher, one line per pair of searchers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from statistics import median

import numpy as np
from attrs import frozen

from grammarbt.report.curves import Point, episodes_to
from grammarbt.report.history import History
from grammarbt.report.statistics import (
    Interval,
    bootstrap,
    holm,
    interquartile_mean,
    mean,
    mean_ranks,
    paired_p_value,
    probability_of_improvement,
    share,
)

_SEED = 20200529
"""Of the resampling, so that the same runs give the same table."""


@frozen
class Entrant:
    """The finished runs of one searcher on one domain.

    Attributes:
        domain: the domain's title.
        searcher: the searcher's title.
        runs: by seed.
        curves: by seed, where they were measured.
    """

    domain: str
    searcher: str
    runs: Mapping[int, History]
    curves: Mapping[int, Sequence[Point]]


@frozen
class Row:
    """How a searcher did on a domain.

    Attributes:
        runs: how many finished.
        value: interquartile mean of the final trees' values.
        ratio: mean of value over reference, run by run; None where the reference is not positive.
        worst: the lowest value.
        complete: share of runs whose tree is complete; None where that cannot be said.
        reached: share of runs whose curve reaches the target for good.
        episodes: median episodes until then, of all runs; None if half of them or more never do.
        rank: mean rank among the searchers, over the seeds that all of them have.
    """

    domain: str
    searcher: str
    runs: int
    value: Interval
    ratio: Interval | None
    worst: float
    complete: Interval | None
    reached: Interval | None
    episodes: float | None
    rank: float | None


@frozen
class Pair:
    """Two searchers on a domain, over the seeds that both have.

    Attributes:
        better: how likely a run of the first beats one of the second.
        difference: mean difference of values on equal seeds, which share their worlds.
        p_value: of no difference, corrected by Holm's method for all pairs of the domain.
    """

    domain: str
    first: str
    second: str
    better: Interval
    difference: float
    p_value: float


@frozen
class Comparison:
    """All of it."""

    rows: tuple[Row, ...]
    pairs: tuple[Pair, ...]


def compare(entrants: Sequence[Entrant], target: float) -> Comparison:
    """Compare searchers, domain by domain.

    Args:
        entrants: in the order of the table.
        target: share of the reference's value that counts as reached.
    """
    rng = np.random.default_rng(_SEED)
    rows: list[Row] = []
    pairs: list[Pair] = []
    for domain in dict.fromkeys(entrant.domain for entrant in entrants):
        own = [entrant for entrant in entrants if entrant.domain == domain and entrant.runs]
        ranks = _ranks(own)
        rows += [_row(entrant, rank, target, rng) for entrant, rank in zip(own, ranks, strict=True)]
        pairs += _pairs(own, rng)
    return Comparison(tuple(rows), tuple(pairs))


def _row(entrant: Entrant, rank: float | None, target: float, rng: np.random.Generator) -> Row:
    runs = list(entrant.runs.values())
    values = _values(runs)
    ratios = [run.ratio for run in runs if run.ratio is not None]
    judged = [run.complete for run in runs if run.complete is not None]
    reached = _episodes_to_target(entrant, target)
    return Row(
        entrant.domain,
        entrant.searcher,
        len(runs),
        bootstrap(values, interquartile_mean, rng),
        bootstrap(ratios, mean, rng) if len(ratios) == len(runs) else None,
        min(values),
        share(sum(judged), len(judged)) if judged else None,
        None if reached is None else share(sum(each < np.inf for each in reached), len(reached)),
        None if reached is None or median(reached) == np.inf else median(reached),
        rank,
    )


def _episodes_to_target(entrant: Entrant, target: float) -> list[float] | None:
    """Per run, infinite where it is never reached; None where there is no reference or no curve."""
    found: list[float] = []
    for seed, points in entrant.curves.items():
        reference = entrant.runs[seed].reference
        if reference is not None:
            # Below zero, a share of the reference means as much worse than it as it would mean above.
            level = reference.mean - (1.0 - target) * abs(reference.mean)
            reached = episodes_to(points, level)
            found.append(np.inf if reached is None else reached)
    return found or None


def _ranks(own: Sequence[Entrant]) -> list[float | None]:
    seeds = _common_seeds(own)
    if len(own) < 2 or not seeds:  # noqa: PLR2004 - a rank needs somebody else
        return [None] * len(own)
    table = np.array([_values([entrant.runs[seed] for entrant in own]) for seed in seeds])
    return [float(rank) for rank in mean_ranks(table)]


def _pairs(own: Sequence[Entrant], rng: np.random.Generator) -> list[Pair]:
    found: list[tuple[Entrant, Entrant, list[float], list[float]]] = []
    for first, second in combinations(own, 2):
        seeds = _common_seeds([first, second])
        if seeds:
            mine, theirs = (_values([each.runs[seed] for seed in seeds]) for each in (first, second))
            found.append((first, second, mine, theirs))
    corrected = holm([paired_p_value(mine, theirs, rng) for _, _, mine, theirs in found])
    return [
        Pair(
            first.domain,
            first.searcher,
            second.searcher,
            probability_of_improvement(mine, theirs, rng),
            float(np.mean(mine) - np.mean(theirs)),
            p_value,
        )
        for (first, second, mine, theirs), p_value in zip(found, corrected, strict=True)
    ]


def _common_seeds(entrants: Sequence[Entrant]) -> list[int]:
    return [seed for seed in entrants[0].runs if all(seed in entrant.runs for entrant in entrants)] if entrants else []


def _values(runs: Sequence[History]) -> list[float]:
    return [run.best.mean for run in runs if run.best is not None]
