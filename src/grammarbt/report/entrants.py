"""From runs to what is compared: grouped by domain and searcher, with their curves measured."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, cast

from grammarbt.report.comparison import Entrant
from grammarbt.report.curves import Point, measure_curve
from grammarbt.run.score import Validator

if TYPE_CHECKING:
    from grammarbt.domain import Domain
    from grammarbt.plugins import Registry
    from grammarbt.report.history import History

Titled = tuple[str, str, "History"]
"""A run with what tables call its domain and its searcher."""


def entrants_of(runs: Iterable[Titled], curves: Callable[[History], Sequence[Point]] | None) -> list[Entrant]:
    """Group runs; those that did not finish are left out.

    Args:
        runs: with their titles.
        curves: measures a run's curve; None for no curves.
    """
    found: dict[tuple[str, str], dict[int, History]] = {}
    for domain, searcher, history in runs:
        own = found.setdefault((domain, searcher), {})
        if history.finished and history.best is not None:
            own[history.seed] = history
    return [
        Entrant(domain, searcher, own, {seed: curves(run) for seed, run in own.items()} if curves else {})
        for (domain, searcher), own in found.items()
    ]


def titles_of(history: History) -> tuple[str, str]:
    """What tables call a run's domain and searcher: the names, with the settings that were given."""
    return _title(history.domain, _given(history, "domain")), _title(history.searcher, _given(history, "searcher"))


def curve_measurer(registry: Registry, episodes: int) -> Callable[[History], Sequence[Point]]:
    """Measures runs' curves on fresh worlds, `episodes` per point."""

    def measure(history: History) -> Sequence[Point]:
        validator = Validator(domain_of(history, registry), history.seed)
        return measure_curve(history, validator, int(history.resolved["budget"]), episodes)

    return measure


def domain_of(history: History, registry: Registry) -> Domain:
    """The run's domain, with the parameters it had; a file's path means what it meant where the run began.

    Raises:
        GrammarBTError: it cannot be made here.
    """
    began = Path(str(history.resolved.get("directory", "")))
    with contextlib.chdir(began if began.is_dir() else Path()):
        return registry.make_domain(history.domain, _given(history, "domain"))


def _given(history: History, part: str) -> dict[str, object]:
    return dict(cast("dict[str, dict[str, object]]", history.resolved["spec"]["set"]).get(part, {}))


def _title(name: str, settings: dict[str, object]) -> str:
    listed = ",".join(f"{key}={value}" for key, value in settings.items())
    return f"{name}({listed})" if listed else name
