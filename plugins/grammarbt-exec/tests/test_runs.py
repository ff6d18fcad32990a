"""The domain in real runs: the worked examples learn, worker processes agree, faults cost their trials alone."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from grammarbt.cli import main

EXAMPLES = Path(__file__).parents[3] / "docs" / "examples" / "exec"


def run(folder, command, *arguments, budget=300):
    """A run's exit code and the events of its journal."""
    line = ["run", "--domain", "exec", "--set", f"domain.command={command}", "--searcher", "random", "--quiet"]
    code = main([*line, "--budget", str(budget), "--validation", "50", "--out", str(folder), *arguments])
    return code, folder / "journal.jsonl"


def best_and_first_value(journal):
    events = [json.loads(line) for line in journal.read_text(encoding="utf-8").splitlines()]
    (best,) = (event for event in events if event["event"] == "validation" and event["name"] == "best")
    returns = [event["returns"][0] for event in events if event["event"] == "trial" and event["returns"]]
    return best["mean"], sum(returns) / len(returns)


@pytest.fixture(scope="module")
def rover(tmp_path_factory):
    compiler = shutil.which("cc")
    assert compiler, "the example in C needs a C compiler"
    program = tmp_path_factory.mktemp("rover") / "rover"
    flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O1", "-fsanitize=undefined"]
    subprocess.run([compiler, *flags, "-o", str(program), str(EXAMPLES / "rover.c")], check=True)
    return str(program)


def test_the_example_in_c_learns(rover, tmp_path):
    code, journal = run(tmp_path / "run", rover, "--seed", str(2**31 - 1))
    best, first = best_and_first_value(journal)
    assert code == 0
    assert best > first + 10


def test_the_example_in_python_learns_without_grammarbt(tmp_path):
    code, journal = run(tmp_path / "run", f"{sys.executable} -I -S {EXAMPLES / 'greenhouse.py'}")
    best, first = best_and_first_value(journal)
    assert code == 0
    assert best > first + 20


@pytest.mark.parametrize("fault", ["dies", "wrong-id", "refuses"])
def test_the_journal_does_not_depend_on_the_workers_even_when_programs_fail(stray, tmp_path, fault):
    journals = [
        run(tmp_path / workers, stray(fault, "-", 7), "--batch", "5", "--workers", workers, "--trials", "40")[1]
        for workers in ("1", "2")
    ]
    assert b'"status":"failed"' in journals[0].read_bytes()
    assert journals[0].read_bytes() == journals[1].read_bytes()


def test_a_run_in_worker_processes_leaves_no_program_behind(stray, gone, holds_within, tmp_path):
    mark = tmp_path / "mark"
    line = ["run", "--searcher", "random", "--domain", "exec", "--set", "domain.timeout=600"]
    line += ["--set", f"domain.command={stray('hangs', mark)}", "--workers", "2", "--batch", "4"]
    process = subprocess.Popen(
        [sys.executable, "-m", "grammarbt", *line, "--out", str(tmp_path / "run")],
        stderr=subprocess.DEVNULL,
    )
    assert holds_within(20, lambda: mark.exists() and len(mark.read_text().split()) == 6)
    process.kill()
    process.wait()
    programs = [int(number) for number in mark.read_text().split()]
    assert holds_within(5, lambda: gone(programs))


def test_listing_the_domain_needs_no_program(capsys):
    assert main(["plugins", "exec"]) == 0
    assert "domain.timeout" in capsys.readouterr().out


def test_announcing_the_domain_imports_neither_numpy_nor_subprocess():
    code = "import sys, grammarbt_exec.hooks; print(sorted({'numpy', 'subprocess'} & set(sys.modules)))"
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert printed.strip() == "[]"
