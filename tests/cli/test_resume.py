"""`grammarbt resume`, after real kills of real processes."""

import json
import shlex
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from corridor_runs import IN_CORRIDOR, grammarbt, journal, run

from grammarbt.cli import main
from grammarbt.run.journal import Journal, read_journal

MARINE = ("--domain", "marine", "--budget", "400", "--validation", "20", "--batch", "7", "--seed", "3")


def kill_at(folder, size, arguments):
    """Start a run and end it with SIGKILL when its journal has reached a size."""
    command = [sys.executable, "-m", "grammarbt", "run", *arguments, "--quiet", "--out", str(folder)]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
        path = folder / "journal.jsonl"
        while process.poll() is None and not (path.exists() and path.stat().st_size >= size):
            time.sleep(0.0005)
        process.kill()


@pytest.mark.parametrize("searcher", ["dagmcts", "random"])
def test_a_run_killed_at_any_moment_ends_with_the_journal_of_an_uninterrupted_one(tmp_path, searcher):
    arguments = (*MARINE, "--searcher", searcher)
    whole = journal(run(tmp_path / "whole", *arguments))
    chance = np.random.default_rng(len(searcher))
    for number in range(2):
        folder = tmp_path / str(number)
        kill_at(folder, int(chance.integers(len(whole))), arguments)
        grammarbt("resume", str(folder))
        assert journal(folder) == whole


def test_a_finished_run_says_the_same_again(finished, capsys):
    before = journal(finished)
    assert main(["resume", str(finished), "--json"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["tree"] == (finished / "best.tree").read_text(encoding="utf-8").strip()
    assert journal(finished) == before


def test_a_larger_budget_gives_the_run_that_had_it_from_the_beginning(copy, tmp_path):
    larger = run(tmp_path / "larger", *IN_CORRIDOR, "--budget", "150")
    grammarbt("resume", str(copy), "--budget", "150")
    assert journal(copy) == journal(larger)
    grammarbt("resume", str(copy))
    assert journal(copy) == journal(larger)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [(["nowhere"], "nowhere/run.json"), ([str(Path(__file__).parent)], "run.json"), (["--budget", "x"], "x")],
)
def test_what_is_no_run_is_one_line_and_exit_2(capsys, arguments, message):
    assert main(["resume", *arguments]) == 2
    assert message in capsys.readouterr().err.splitlines()[0]


def test_a_smaller_budget_is_refused(copy, capsys):
    assert main(["resume", str(copy), "--budget", "10"]) == 2
    assert "budget of 60 already" in capsys.readouterr().err


def test_a_run_on_a_full_disk_ends_with_one_line_and_is_resumed_to_the_same_bytes(finished, tmp_path):
    folder = tmp_path / "run"
    command = [
        sys.executable,
        "-m",
        "grammarbt",
        "run",
        *IN_CORRIDOR,
        "--budget",
        "60",
        "--quiet",
        "--out",
        str(folder),
    ]
    full = f"ulimit -f {len(journal(finished)) // 2048} && exec {shlex.join(command)}"  # in blocks of 1,024 bytes
    done = subprocess.run(["/bin/bash", "-c", full], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "cannot write" in done.stderr.splitlines()[0]
    grammarbt("resume", str(folder))
    assert journal(folder) == journal(finished)


def test_the_clock_of_a_run_counts_on(tmp_path):
    folder = run(tmp_path / "run", *IN_CORRIDOR, "--budget", "60", "--seconds", "1000")
    whole = journal(folder)
    (folder / "journal.jsonl").write_bytes(b"".join(whole.splitlines(keepends=True)[:10]))
    (folder / "timing.jsonl").write_text('{"batch":1,"episodes":7,"seconds":5000.0}\n{"batch":2,"epi')
    grammarbt("resume", str(folder))
    (searched,) = (event for event in read_journal(folder / "journal.jsonl") if event["event"] == "searched")
    assert searched["stopped"] == "seconds"
    assert searched["trials"] < 60
    grammarbt("resume", str(folder))


def test_a_run_in_use_is_refused_in_one_line(copy, capsys):
    before = journal(copy)
    with closing(Journal.open(copy / "journal.jsonl")):
        assert main(["resume", str(copy), "--quiet"]) == 2
    assert "in use by another run" in capsys.readouterr().err.splitlines()[0]
    assert journal(copy) == before
