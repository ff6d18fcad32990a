"""Simulating on dask gives what one process gives, and survives workers and schedulers that die."""

import contextlib
import json
import os
import signal
import socket
import subprocess
import sys
import time
from concurrent.futures import BrokenExecutor
from functools import partial
from pathlib import Path

import pytest
from distributed import LocalCluster

from grammarbt.cli import main
from grammarbt.errors import RunError
from grammarbt_dask.executor import DaskExecutor
from grammarbt_dask.parameters import DaskParameters

TESTS = Path(__file__).parent
CORRIDOR = f"{TESTS.parents[2] / 'docs' / 'examples' / 'corridor.py'}:Corridor"
WORLD = f"{TESTS / 'worlds.py'}:World"
PATIENCE = 120  # seconds until an answer that never comes is a failure


def run(folder, domain, *arguments, budget=200):
    """A run's exit code and journal."""
    line = ["run", "--domain", domain, "--searcher", "random", "--budget", str(budget), "--validation", "2", "--quiet"]
    return main([*line, "--batch", "20", "--out", str(folder), *arguments]), folder / "journal.jsonl"


@pytest.fixture
def dask():
    """Makes executors, and shuts them down in the end."""
    made = []

    def make(workers=1, initializer=os.getpid, **parameters):
        made.append(DaskExecutor(workers, initializer, DaskParameters(**parameters)))
        return made[-1]

    yield make
    for executor in made:
        executor.shutdown()


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    """The journal's bytes of the corridor, simulated in one process."""
    return run(tmp_path_factory.mktemp("serial") / "run", CORRIDOR)[1].read_bytes()


@pytest.mark.parametrize("workers", ["1", "2", "4"])
def test_the_journal_is_that_of_a_serial_run(tmp_path, serial, workers):
    code, journal = run(tmp_path / "run", CORRIDOR, "--executor", "dask", "--workers", workers)
    assert code == 0
    assert journal.read_bytes() == serial


def test_calls_run_in_worker_processes_that_were_made_ready_once(dask, tmp_path):
    marks = tmp_path / "marks"
    note_process = partial(os.system, f"echo $PPID >> '{marks}'")  # what workers can import wherever pytest was started
    executor = dask(workers=2, initializer=note_process)
    processes = {future.result() for future in [executor.submit(os.getpid) for _ in range(40)]}
    assert os.getpid() not in processes
    noted = marks.read_text().split()
    assert sorted(noted) == sorted(set(noted))
    assert {str(process) for process in processes} <= set(noted)


def test_many_short_calls_travel_in_few_bundles(dask, tmp_path):
    executor = dask()
    executor.submit(abs, 0).result()
    started = time.monotonic()
    executor.submit(abs, 0).result()
    once = time.monotonic() - started
    futures = [executor.submit(abs, -number) for number in range(1000)]
    assert [future.result() for future in futures] == list(range(1000))
    assert time.monotonic() - started < 1000 * once / 5


def test_a_call_that_kills_its_worker_is_told_from_those_beside_it(dask):
    executor = dask()
    before = [executor.submit(abs, -number) for number in range(5)]
    deadly = executor.submit(os._exit, 3)
    after = [executor.submit(abs, -number) for number in range(5)]
    with pytest.raises(BrokenExecutor, match="ended its worker"):
        deadly.result(PATIENCE)
    assert [future.result(PATIENCE) for future in before + after] == [*range(5), *range(5)]


def test_calls_do_not_wait_for_ever_when_no_worker_comes_in_the_place_of_one_that_died(dask, monkeypatch):
    started = []
    monkeypatch.setattr(
        "grammarbt_dask.cluster.LocalCluster", lambda **given: started.append(LocalCluster(**given)) or started[0]
    )
    executor = dask(patience=15)
    assert executor.submit(abs, -1).result(PATIENCE) == 1
    started[0].scale(0)
    wait_for(lambda: not started[0].scheduler.workers)
    with pytest.raises(RunError, match="none has come in their place"):
        executor.submit(abs, -1).result(PATIENCE)


def test_an_error_in_a_call_is_that_call_s_own(dask):
    executor = dask()
    futures = [executor.submit(divmod, 1, number) for number in range(2)]
    with pytest.raises(RunError, match="ZeroDivisionError"):
        futures[0].result()
    assert futures[1].result() == (1, 0)


def test_a_start_that_fails_says_why(dask):
    with pytest.raises(RunError, match="ZeroDivisionError"):
        dask(initializer=partial(divmod, 1, 0)).submit(os.getpid).result()


def test_trees_that_kill_their_worker_fail_and_no_others(tmp_path):
    arguments = ("--workers", "2", "--set", "domain.deadly=9", "--trials", "20")
    found = [
        statuses(run(tmp_path / executor, WORLD, "--executor", executor, *arguments)[1])
        for executor in ("processes", "dask")
    ]
    assert set(found[0]) == {"ok", "failed"}
    assert found[0] == found[1]


def statuses(journal):
    events = [json.loads(line) for line in journal.read_text(encoding="utf-8").splitlines()]
    return [event["status"] for event in events if event["event"] == "trial"]


@pytest.fixture
def start():
    """Starts commands, and kills them in the end."""
    started = []

    def start(*line):
        command = [sys.executable, "-m", *line]
        started.append(subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True))
        return started[-1]

    yield start
    for process in started:
        process.kill()
        process.communicate()


def wait_for(condition, seconds=120):
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def slow_run(folder, *arguments, seconds=0.01):
    """The command line of a run of two hundred simulations of so many seconds."""
    line = ["run", "--domain", WORLD, "--searcher", "random", "--budget", "200", "--validation", "2", "--quiet"]
    return ["grammarbt", *line, "--batch", "20", "--set", f"domain.seconds={seconds}", "--out", str(folder), *arguments]


def trials(journal):
    return journal.read_bytes().count(b'"trial"') if journal.exists() else 0


def kill_one(processes):
    """Kill the first that is still there."""
    for process in processes:
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
            return
    pytest.fail("there is no worker to kill")


def test_workers_killed_midway_change_no_byte(start, tmp_path):
    whole, killed, marks = tmp_path / "whole", tmp_path / "killed", tmp_path / "marks"
    assert start(*slow_run(whole)).wait(120) == 0
    dask = ["--executor", "dask", "--workers", "2", "--set", f"domain.marks={marks}"]
    process = start(*slow_run(killed, *dask))
    for progress in (20, 80):
        wait_for(lambda: trials(killed / "journal.jsonl") >= progress)  # noqa: B023 - awaited at once
        kill_one(int(number) for number in marks.read_text().split() if int(number) != process.pid)
    assert process.wait(120) == 0
    assert len(marks.read_text().split()) >= 5
    assert (killed / "journal.jsonl").read_bytes() == (whole / "journal.jsonl").read_bytes()


def test_ctrl_c_in_a_terminal_ends_a_run_with_one_line(start, tmp_path):
    process = start(*slow_run(tmp_path / "run", "--executor", "dask", "--workers", "2", seconds=0.1))
    wait_for(lambda: trials(tmp_path / "run" / "journal.jsonl") >= 20)
    os.killpg(process.pid, signal.SIGINT)
    errors = process.communicate(timeout=120)[1].splitlines()
    assert process.returncode == 130
    assert list(filter(None, errors)) == [f"interrupted; go on with: grammarbt resume {tmp_path / 'run'}"]


@pytest.fixture
def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.fixture
def cluster(start, free_port):
    """Starts a scheduler with one worker at an address that stays the same; gives the scheduler."""
    address = f"tcp://127.0.0.1:{free_port}"

    def begin():
        host = ("--host", "127.0.0.1", "--no-dashboard")
        scheduler = start("distributed.cli.dask_scheduler", "--port", str(free_port), *host)
        start("distributed.cli.dask_worker", address, "--nthreads", "2", "--no-dashboard", "--no-nanny")
        return scheduler

    begin.address = address
    return begin


def test_a_run_whose_scheduler_is_killed_says_so_and_goes_on_later(start, cluster, tmp_path):
    whole, cut = tmp_path / "whole", tmp_path / "cut"
    assert start(*slow_run(whole)).wait(120) == 0
    scheduler = cluster()
    process = start(*slow_run(cut, "--executor", "dask", "--set", f"executor.address={cluster.address}"))
    wait_for(lambda: trials(cut / "journal.jsonl") >= 40)
    scheduler.kill()
    errors = process.communicate(timeout=120)[1].splitlines()
    assert process.returncode == 2
    assert errors == [
        "error: the connection to the dask scheduler is lost",
        "hint: when it runs again, go on with 'grammarbt resume'",
    ]
    assert 40 <= trials(cut / "journal.jsonl") < trials(whole / "journal.jsonl")
    cluster()
    assert start("grammarbt", "resume", str(cut), "--quiet").wait(120) == 0
    assert (cut / "journal.jsonl").read_bytes() == (whole / "journal.jsonl").read_bytes()


def test_two_runs_that_share_a_worker_keep_their_domains_apart(cluster, dask):
    cluster()
    names = ("first", "second")
    runs = [dask(initializer=partial(setattr, os, "ready_for", name), address=cluster.address) for name in names]
    for name, executor in [*zip(names, runs, strict=True)] * 3:
        assert executor.submit(getattr, os, "ready_for").result() == name


def test_an_address_without_a_scheduler_is_one_error(dask, free_port):
    executor = dask(address=f"tcp://127.0.0.1:{free_port}", patience=0.5)
    with pytest.raises(RunError, match=f"no dask scheduler at tcp://127.0.0.1:{free_port}"):
        executor.submit(abs, -1)


def test_announcing_the_executor_does_not_import_dask():
    code = "import sys, grammarbt_dask.hooks, grammarbt_dask.parameters; print('distributed' in sys.modules)"
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert printed.strip() == "False"
