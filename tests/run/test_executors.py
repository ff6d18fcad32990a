"""Worker processes give what one process gives, and survive what it cannot."""

import json
import os
import signal
import time
from collections import Counter
from concurrent.futures import BrokenExecutor
from functools import partial
from pathlib import Path

import pytest

from grammarbt.cli import main
from grammarbt.errors import RunError
from grammarbt.run.executors import ProcessExecutor
from grammarbt.run.journal import read_journal
from grammarbt.run.process import Limits

FAULTY = f"{Path(__file__).parent / 'faulty.py'}:Faulty"
CORRIDOR = f"{Path(__file__).parents[2] / 'docs' / 'examples' / 'corridor.py'}:Corridor"


def run(folder, domain, *arguments, budget=120):
    """A run's exit code and journal."""
    line = ["run", "--domain", domain, "--searcher", "random", "--budget", str(budget), "--validation", "2", "--quiet"]
    code = main([*line, "--out", str(folder), *arguments])
    return code, folder / "journal.jsonl"


def statuses(path):
    return Counter(event["status"] for event in read_journal(path) if event["event"] == "trial")


@pytest.mark.parametrize("batch", ["1", "9"])
def test_the_journal_does_not_depend_on_the_workers(tmp_path, batch):
    found = [
        run(tmp_path / workers, CORRIDOR, "--batch", batch, "--executor", executor, "--workers", workers)[
            1
        ].read_bytes()
        for executor, workers in (("serial", "1"), ("processes", "2"), ("processes", "4"))
    ]
    assert found[0] == found[1] == found[2]


@pytest.fixture
def processes():
    """Makes executors, and shuts them down in the end."""
    made = []

    def make(workers=1, initializer=os.getpid, **limits):
        made.append(ProcessExecutor(workers, initializer, Limits(**limits)))
        return made[-1]

    yield make
    for executor in made:
        executor.shutdown()


def test_a_call_that_takes_too_long_is_ended_and_the_next_finds_a_new_process(processes):
    executor = processes(seconds=0.3)
    before = executor.submit(os.getpid).result()
    with pytest.raises(TimeoutError, match=r"longer than 0\.3 s"):
        executor.submit(time.sleep, 60).result()
    assert executor.submit(os.getpid).result() not in (before, os.getpid())


def test_a_process_that_ends_is_replaced_and_the_others_go_on(processes):
    executor = processes(workers=2)
    slow = executor.submit(time.sleep, 0.5)
    with pytest.raises(BrokenExecutor, match="exit code 3"):
        executor.submit(os._exit, 3).result()
    assert slow.result() is None
    assert executor.submit(abs, -2).result() == 2


def test_a_start_that_fails_says_why(processes):
    with pytest.raises(RunError, match="ZeroDivisionError"):
        processes(initializer=partial(divmod, 1, 0)).submit(os.getpid).result()
    with pytest.raises(RunError, match="exit code 4 at its start"):
        processes(initializer=partial(os._exit, 4)).submit(os.getpid).result()


def test_shutting_down_does_not_wait_for_calls(processes):
    executor = processes()
    process = executor.submit(os.getpid).result()
    executor.submit(time.sleep, 60)
    started = time.monotonic()
    executor.shutdown()
    assert time.monotonic() - started < 10
    with pytest.raises(ProcessLookupError):
        os.kill(process, signal.SIGTERM)


@pytest.mark.parametrize(
    ("fault", "status", "reason"),
    [
        ("raises", "failed", "is broken"),
        ("nan", "invalid", "finite"),
        ("shape", "invalid", "shape"),
        ("hangs", "timeout", "longer than 0.2 s"),
        ("exits", "failed", "exit code 3"),
        ("crashes", "failed", "exit code -11"),
        ("swells", "failed", "more than 250 MB of memory"),
    ],
)
def test_a_fault_now_and_then_fails_its_trials_and_no_others(tmp_path, fault, status, reason):
    limit = "memory=250" if fault == "swells" else "timeout=0.2"
    settings = ("--set", f"domain.{fault}=9", "--set", f"executor.{limit}", "--workers", "2", "--batch", "6")
    _, path = run(tmp_path / "run", FAULTY, *settings, "--trials", "40")
    found = statuses(path)
    assert set(found) == {"ok", status}
    assert found.total() == 40
    assert all(reason in event["error"] for event in read_journal(path) if event.get("status") == status)


def test_a_process_that_ends_once_loses_nothing(tmp_path):
    mark = tmp_path / "mark"
    _, path = run(tmp_path / "run", FAULTY, "--workers", "2", "--set", f"domain.flaky={mark}", "--trials", "20")
    assert mark.exists()
    assert statuses(path) == {"ok": 20}


def test_a_leak_costs_workers_and_no_trial(tmp_path):
    settings = ("--set", "domain.leak=60", "--set", "executor.memory=300", "--workers", "2", "--batch", "6")
    _, path = run(tmp_path / "leaky", FAULTY, *settings, "--trials", "30")
    sound = run(tmp_path / "sound", FAULTY, "--batch", "6", "--trials", "30")[1]
    assert statuses(path) == {"ok": 30}
    assert path.read_bytes() == sound.read_bytes()


def test_a_limit_that_no_worker_can_keep_is_said_at_once(tmp_path, capsys):
    assert run(tmp_path / "run", FAULTY, "--workers", "2", "--set", "executor.memory=5")[0] == 2
    error = capsys.readouterr().err
    assert "more than 5 MB before it simulates" in error
    assert "raise executor.memory" in error


def test_too_many_failures_in_a_row_end_the_run_with_their_cause(tmp_path, capsys):
    code, path = run(tmp_path / "run", FAULTY, "--workers", "2", "--set", "domain.exits=1")
    assert code == 2
    error = capsys.readouterr().err
    assert "25 trials failed in a row, the first with: the simulator ended its process with exit code 3" in error
    assert statuses(path) == {"failed": 25}


def test_a_run_whose_simulator_was_repaired_goes_on(tmp_path):
    mark = tmp_path / "broken"
    mark.touch()
    code, path = run(tmp_path / "run", FAULTY, "--set", f"domain.broken={mark}", "--trials", "40")
    assert (code, statuses(path)) == (2, {"failed": 25})
    mark.unlink()
    assert main(["resume", str(tmp_path / "run"), "--quiet"]) == 0
    assert statuses(path) == {"failed": 25, "ok": 15}


def test_a_run_with_all_faults_now_and_then_ends_with_a_score_and_counts_them(tmp_path, capsys):
    faults = {"raises": 31, "nan": 37, "shape": 41, "exits": 83, "crashes": 89}
    settings = [word for fault, every in faults.items() for word in ("--set", f"domain.{fault}={every}")]
    line = (*settings, "--workers", "2", "--batch", "20", "--validation", "100", "--json")
    code, path = run(tmp_path / "run", FAULTY, *line, budget=300)
    events = read_journal(path)
    assert code == 0
    assert sum(event["simulated"] for event in events if "simulated" in event) <= 300
    (validation,) = (event for event in events if event["event"] == "validation")
    assert 80 <= validation["episodes"] < 100
    result, found = json.loads(capsys.readouterr().out), statuses(path)
    assert set(found) == {"ok", "failed", "invalid"}
    assert found.total() == result["trials"]
    assert result["failed"] == {status: number for status, number in found.items() if status != "ok"}
