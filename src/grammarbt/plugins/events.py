"""What observers are told."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from attrs import frozen

__all__ = ["RunFinished", "RunStarted", "TrialFinished"]


@frozen
class RunStarted:
    """A run begins, or goes on after `episodes` of its budget."""

    run: Path
    domain: str
    searcher: str
    seed: int
    budget: int
    parameters: Mapping[str, object]
    episodes: int = 0


@frozen
class TrialFinished:
    """A tree was evaluated; `value` is its mean return, `best` the best so far."""

    run: Path
    trial: int
    episodes: int
    tree: str
    status: str
    value: float
    best: float
    best_tree: str
    metrics: Mapping[str, float]


@frozen
class RunFinished:
    """A run ended; `result` is the JSON that `grammarbt run --json` prints."""

    run: Path
    result: Mapping[str, object]
