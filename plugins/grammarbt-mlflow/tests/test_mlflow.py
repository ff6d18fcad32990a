"""Runs are tracked when that is wanted, seldom enough, and never at the run's expense."""

import json
import os
import socket
import subprocess
import sys
import threading
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path

import pytest
from mlflow import MlflowClient

from grammarbt.cli import main
from grammarbt.plugins.events import RunFinished, RunStarted, TrialFinished
from grammarbt_mlflow.tracker import Tracker

CORRIDOR = f"{Path(__file__).parents[3] / 'docs' / 'examples' / 'corridor.py'}:Corridor"


@pytest.fixture
def place(tmp_path, monkeypatch):
    """An empty folder to track to; nothing else of MLflow's settings counts."""
    for name in list(os.environ):
        if "MLFLOW" in name:
            monkeypatch.delenv(name)
    monkeypatch.setenv("MLFLOW_ALLOW_FILE_STORE", "true")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(folder="run", *arguments, budget=200):
    line = ["run", "--domain", CORRIDOR, "--searcher", "random", "--budget", str(budget), "--validation", "2"]
    return main([*line, "--quiet", "--seed", "7", "--out", str(folder), *arguments])


def tracked(place):
    """The client, and every run of MLflow in the folder's experiment."""
    client = MlflowClient((place / "mlruns").as_uri())
    experiment = client.get_experiment_by_name("grammarbt")
    return client, client.search_runs([experiment.experiment_id])


def curve(client, found, name="best"):
    return [(point.step, point.value) for point in client.get_metric_history(found.info.run_id, name)]


def test_nothing_is_tracked_unless_asked_for(place, monkeypatch):
    assert run() == 0
    monkeypatch.setenv("GRAMMARBT_MLFLOW", "0")
    monkeypatch.setenv("MLFLOW_TRACKING_URI", (place / "mlruns").as_uri())
    assert run("other") == 0
    assert not (place / "mlruns").exists()


@pytest.mark.parametrize("switch", ["GRAMMARBT_MLFLOW", "MLFLOW_TRACKING_URI"])
def test_a_run_is_tracked_with_its_parameters_curve_score_and_files(place, monkeypatch, switch):
    monkeypatch.setenv(switch, {"GRAMMARBT_MLFLOW": "1"}.get(switch, (place / "mlruns").as_uri()))
    assert run() == 0
    client, (found,) = tracked(place)
    assert found.info.status == "FINISHED"
    assert {"seed": "7", "budget": "200", "searcher": "random"}.items() <= found.data.params.items()
    journal = [json.loads(line) for line in Path("run/journal.jsonl").read_text(encoding="utf-8").splitlines()]
    validated = {event["name"]: event["mean"] for event in journal if event["event"] == "validation"}
    assert found.data.metrics["value"] == validated["best"]
    assert found.data.metrics["reference"] == validated["manual"]
    steps, values = zip(*curve(client, found), strict=True)
    assert sorted(set(steps)) == list(steps)
    assert found.data.metrics["trials"] == sum(event["event"] == "trial" for event in journal)
    assert values[0] < values[-1]
    for name in ("best.tree", "run.json"):
        kept = Path(client.download_artifacts(found.info.run_id, name)).read_bytes()
        assert kept == Path("run", name).read_bytes()


def test_a_resumed_run_goes_on_in_the_same_place(place, monkeypatch):
    monkeypatch.setenv("GRAMMARBT_MLFLOW", "1")
    run()
    client, (found,) = tracked(place)
    before = curve(client, found)
    assert main(["resume", "run", "--budget", "400", "--quiet"]) == 0
    client, (found,) = tracked(place)
    after = curve(client, found)
    assert after[: len(before)] == before
    assert len(after) > len(before)
    steps = [step for step, _ in after]
    assert sorted(set(steps)) == steps


@pytest.fixture
def counted(monkeypatch):
    """How many numbers each call to MLflow carried."""
    calls = []
    send = MlflowClient.log_batch

    def log_batch(client, run_id, metrics=(), params=(), tags=()):
        calls.append(len(metrics))
        return send(client, run_id, metrics=metrics, params=params, tags=tags)

    monkeypatch.setattr(MlflowClient, "log_batch", log_batch)
    return calls


def test_a_million_trials_make_few_calls(place, counted, monkeypatch):
    monkeypatch.setenv("MLFLOW_TRACKING_URI", (place / "mlruns").as_uri())
    run()
    folder = Path("run")
    (folder / "mlflow.id").unlink()
    counted.clear()
    tracker = Tracker(RunStarted(folder, "corridor", "random", 7, 10**6, {}))
    for trial in range(1, 10**6 + 1):
        tracker.trial(TrialFinished(folder, trial, trial, "[a]", "ok", 0.0, trial / 10**6, "[a]", {}))
    tracker.finish(RunFinished(folder, {"stopped": "budget", "value": 1.0}))
    client, runs = tracked(place)
    (found,) = (found for found in runs if found.data.metrics["trials"] == 10**6)
    points = curve(client, found)
    assert 500 < len(points) < 1500
    assert points[-1] == (10**6, 1.0)
    assert max(counted) <= 1000
    assert len(counted) < 50


def one_line_about_mlflow(text):
    (line,) = (line for line in text.splitlines() if "mlflow" in line)
    return line


def test_a_server_that_is_not_there_ends_the_tracking_with_one_line(place, monkeypatch, capsys):
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    monkeypatch.setenv("MLFLOW_TRACKING_URI", f"http://127.0.0.1:{port}")
    assert run() == 0
    line = one_line_about_mlflow(capsys.readouterr().err)
    assert "plugin 'mlflow' of grammarbt-mlflow" in line
    assert "no longer observes" in line
    assert Path("run/best.tree").exists()


class Failing(BaseHTTPRequestHandler):
    """A tracking server whose disk is full."""

    def do_GET(self):
        self.send_error(500, "disk full")

    def do_POST(self):
        self.send_error(500, "disk full")

    def log_message(self, *_):
        pass


def test_a_server_that_fails_ends_the_tracking_with_one_line(place, monkeypatch, capsys):
    server = HTTPServer(("127.0.0.1", 0), Failing)
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    try:
        monkeypatch.setenv("MLFLOW_TRACKING_URI", f"http://127.0.0.1:{server.server_port}")
        monkeypatch.setenv("MLFLOW_HTTP_REQUEST_MAX_RETRIES", "0")
        assert run() == 0
    finally:
        server.shutdown()
        thread.join()
        server.server_close()
    assert "no longer observes" in one_line_about_mlflow(capsys.readouterr().err)


def test_runs_that_are_not_tracked_do_not_import_mlflow(place):
    code = """
import sys
from grammarbt.cli import main
assert main(sys.argv[1:]) == 0
assert "grammarbt_mlflow.hooks" in sys.modules
print("mlflow" in sys.modules)
"""
    line = ["run", "--domain", CORRIDOR, "--searcher", "random", "--budget", "20", "--validation", "2", "--out", "run"]
    printed = subprocess.run([sys.executable, "-c", code, *line], check=True, capture_output=True, text=True).stdout
    assert printed.splitlines()[-1] == "False"
