"""Observes runs when asked to; until then it imports nothing and does nothing."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from grammarbt.plugins import hookimpl

if TYPE_CHECKING:
    from pathlib import Path

    from grammarbt.plugins.events import RunFinished, RunStarted, TrialFinished
    from grammarbt_mlflow.tracker import Tracker

GRAMMARBT_API = 1

_trackers: dict[Path, Tracker] = {}
"""Of the runs that go on, by folder."""


@hookimpl
def grammarbt_run_started(event: RunStarted) -> None:
    """Begin to track, if that is wanted."""
    if _wanted():
        from grammarbt_mlflow.tracker import Tracker  # noqa: PLC0415 - brings mlflow, which takes a second

        _trackers[event.run] = Tracker(event)


@hookimpl
def grammarbt_trial_finished(event: TrialFinished) -> None:
    """Note a point of the learning curve."""
    if event.run in _trackers:
        _trackers[event.run].trial(event)


@hookimpl
def grammarbt_run_finished(event: RunFinished) -> None:
    """Save what was found."""
    if event.run in _trackers:
        _trackers.pop(event.run).finish(event)


def _wanted() -> bool:
    """What `GRAMMARBT_MLFLOW` says; else whether MLflow has been told where to track."""
    said = os.environ.get("GRAMMARBT_MLFLOW", "")
    return said.lower() not in {"0", "off", "no", "false"} if said else bool(os.environ.get("MLFLOW_TRACKING_URI"))
