"""One run of grammarbt as one run of MLflow."""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import TYPE_CHECKING

from mlflow.entities import Metric, Param

from grammarbt_mlflow.settings import open_experiment, parameters, score

if TYPE_CHECKING:
    from collections.abc import Mapping

    from grammarbt.plugins.events import RunFinished, RunStarted, TrialFinished

_GROWTH = 1.01
"""Episodes between two points of a curve grow by this factor: 1,400 points suffice for a million episodes."""

_EVERY = 5.0
"""Seconds between two calls to the server, at least."""

_MOST = 900
"""Numbers sent in one call; MLflow takes 1,000."""

_MOST_PARAMETERS = 100
"""Parameters that MLflow takes in one call."""

_STATUS = {"failed": "FAILED", "interrupted": "KILLED"}
_ID = "mlflow.id"
"""The file in the run folder that says which run of MLflow it is, so that a resumed run goes on there."""


class Tracker:
    """Sends what happens to MLflow, seldom and many numbers at a time.

    Args:
        event: the beginning of the run.
    """

    def __init__(self, event: RunStarted) -> None:
        self._client, experiment = open_experiment()
        self._run = self._known(event.run) or self._begun(event, experiment)
        self._next = self._last_step() + 1
        self._counts = {"trials": 0, "failed": 0}
        self._latest: TrialFinished | None = None
        self._noted: TrialFinished | None = None
        self._unsent: list[Metric] = []
        self._sent = time.monotonic()

    def trial(self, event: TrialFinished) -> None:
        """A point of the curves, if the last one is long enough ago."""
        self._counts["trials"] += 1
        self._counts["failed"] += event.status != "ok"
        self._latest = event
        if event.episodes >= self._next:
            self._next = max(event.episodes + 1, math.ceil(event.episodes * _GROWTH))
            self._note(event)

    def finish(self, event: RunFinished) -> None:
        """The last point, the score, the files, and how it ended."""
        if self._latest is not None and self._latest is not self._noted:
            self._note(self._latest)
        self._add(score(event.result), self._latest.episodes if self._latest else 0)
        self._send()
        for name in ("best.tree", "run.json"):
            if (event.run / name).exists():
                self._client.log_artifact(self._run, str(event.run / name))
        self._client.set_terminated(self._run, _STATUS.get(str(event.result.get("stopped")), "FINISHED"))

    def _known(self, folder: Path) -> str | None:
        """The run of MLflow that this folder was tracked as before, if it is still there."""
        file = folder / _ID
        if not file.exists():
            return None
        name = file.read_text(encoding="utf-8").strip()
        self._client.update_run(name, status="RUNNING")
        return name

    def _begun(self, event: RunStarted, experiment: str) -> str:
        tags = {"grammarbt.folder": str(event.run.absolute()), "grammarbt.domain": event.domain}
        run = self._client.create_run(experiment, tags=tags, run_name=event.run.name)
        name = str(run.info.run_id)
        chosen = [Param(key, value) for key, value in parameters(event)]
        for first in range(0, len(chosen), _MOST_PARAMETERS):
            self._client.log_batch(name, params=chosen[first : first + _MOST_PARAMETERS])
        (event.run / _ID).write_text(name + "\n", encoding="utf-8")
        return name

    def _last_step(self) -> int:
        """How far an earlier part of the run has come."""
        return max((point.step for point in self._client.get_metric_history(self._run, "best")), default=-1)

    def _note(self, event: TrialFinished) -> None:
        self._noted = event
        self._add({"best": event.best, **self._counts, **event.metrics}, event.episodes)
        if len(self._unsent) >= _MOST or time.monotonic() - self._sent >= _EVERY:
            self._send()

    def _add(self, numbers: Mapping[str, float], step: int) -> None:
        now = int(time.time() * 1000)
        self._unsent += [Metric(key, float(value), now, step) for key, value in numbers.items() if math.isfinite(value)]

    def _send(self) -> None:
        for first in range(0, len(self._unsent), _MOST):
            self._client.log_batch(self._run, metrics=self._unsent[first : first + _MOST])
        self._unsent.clear()
        self._sent = time.monotonic()
