"""Where MLflow tracks, how patient it is, and which parameters it is told."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from mlflow import MlflowClient

if TYPE_CHECKING:
    from grammarbt.plugins.events import RunStarted

LOCAL = "mlruns"
"""The folder to track to when no place is named."""

EXPERIMENT = "grammarbt"

_PATIENCE = {
    "MLFLOW_HTTP_REQUEST_MAX_RETRIES": "2",
    "MLFLOW_HTTP_REQUEST_BACKOFF_FACTOR": "1",
    "MLFLOW_HTTP_REQUEST_TIMEOUT": "10",
    "MLFLOW_ALLOW_FILE_STORE": "true",
}
"""MLflow's settings unless the user has chosen others; its own would keep a run waiting for minutes."""

_LONGEST = 500


def open_experiment() -> tuple[MlflowClient, str]:
    """MLflow's client, and the number of the experiment that runs are tracked in, which is made if it is new."""
    for name, value in _PATIENCE.items():
        os.environ.setdefault(name, value)
    client = MlflowClient(os.environ.get("MLFLOW_TRACKING_URI") or Path(LOCAL).absolute().as_uri())
    name = os.environ.get("MLFLOW_EXPERIMENT_NAME") or EXPERIMENT
    known = client.get_experiment_by_name(name)
    return client, str(known.experiment_id if known else client.create_experiment(name))


def parameters(event: RunStarted) -> Iterator[tuple[str, str]]:
    """What the run was started with, defaults included: names with dots, and texts."""
    resolved = json.loads((event.run / "run.json").read_text(encoding="utf-8"))
    for key in ("seed", "budget", "batch"):
        yield key, str(resolved[key])
    yield "grammar", resolved["grammar"]["name"]
    for part in ("domain", "searcher"):
        yield part, resolved[part]["name"]
        for key, value in resolved[part]["parameters"].items():
            yield f"{part}.{key}", str(value)[:_LONGEST]


def score(result: Mapping[str, object]) -> dict[str, float]:
    """The numbers of a run's result that are to be compared between runs."""
    reference = result.get("reference")
    found = {key: result.get(key) for key in ("value", "stderr", "ratio")}
    found["reference"] = reference.get("value") if isinstance(reference, Mapping) else None
    return {key: float(value) for key, value in found.items() if isinstance(value, int | float)}
