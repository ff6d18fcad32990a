"""How fast a run was, and what its searcher said of itself on the way: read from `timing.jsonl`."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

from attrs import field, frozen

_TAIL = 2**16
"""Bytes at the end of the file that tell how fast the run is now."""


@frozen
class Instant:
    """A line of the file.

    Attributes:
        episodes: simulated since the line before.
        seconds: that the run had taken.
        metrics: the searcher's, by name.
    """

    episodes: int
    seconds: float
    metrics: Mapping[str, float] = field(factory=dict)


Timing: TypeAlias = Sequence[Instant]


def read_timing(path: Path) -> Timing:
    """All lines that can be read; the clock is no part of what a run must keep."""
    try:
        with path.open(encoding="utf-8", errors="replace") as file:
            return list(_instants(file))
    except OSError:
        return []


def episodes_per_second(path: Path) -> float | None:
    """Of the last part of a run, which may be going on; None while too little is known."""
    try:
        with path.open("rb") as file:
            file.seek(max(0, path.stat().st_size - _TAIL))
            lines = file.read().decode("utf-8", errors="replace").splitlines()
    except OSError:
        return None
    known = list(_instants(lines))
    seconds = known[-1].seconds - known[0].seconds if known else 0.0
    return sum(each.episodes for each in known[1:]) / seconds if seconds > 0 else None


def _instants(lines: Iterable[str]) -> Iterator[Instant]:
    for line in lines:
        try:
            content = json.loads(line)
            metrics = {str(name): float(value) for name, value in content.get("metrics", {}).items()}
            yield Instant(int(content["episodes"]), float(content["seconds"]), metrics)
        except (ValueError, KeyError, TypeError, AttributeError):  # a torn line
            continue
