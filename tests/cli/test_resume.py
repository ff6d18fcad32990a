"""`grammarbt resume`, after real kills of real processes."""

import contextlib
import io
import json
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.cli import main
from grammarbt.run.folder import RunFolder
from grammarbt.run.journal import Journal, read_journal

CORRIDOR = f"{Path(__file__).parents[2] / 'docs' / 'examples' / 'corridor.py'}:Corridor"
MARINE = ("--domain", "marine", "--budget", "400", "--validation", "20", "--batch", "7", "--seed", "3")
SMALL = ("--domain", CORRIDOR, "--searcher", "random", "--validation", "20", "--seed", "3", "--batch", "7")


def grammarbt(*arguments):
    assert main([*arguments, "--quiet"]) == 0


def run(folder, *arguments):
    grammarbt("run", *arguments, "--out", str(folder))
    return folder


def journal(folder):
    return (folder / "journal.jsonl").read_bytes()


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


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A small finished run."""
    return run(tmp_path_factory.mktemp("runs") / "run", *SMALL, "--budget", "60")


@pytest.fixture
def copy(finished, tmp_path):
    """A copy of it, to be damaged."""
    return Path(shutil.copytree(finished, tmp_path / "copy"))


def test_a_journal_cut_anywhere_is_completed_to_the_same_bytes(finished, copy):
    whole = journal(finished)
    for size in range(0, len(whole), len(whole) // 40):
        (copy / "journal.jsonl").write_bytes(whole[:size])
        grammarbt("resume", str(copy))
        assert journal(copy) == whole


def test_a_finished_run_says_the_same_again(finished, capsys):
    before = journal(finished)
    assert main(["resume", str(finished), "--json"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["tree"] == (finished / "best.tree").read_text(encoding="utf-8").strip()
    assert journal(finished) == before


def test_a_larger_budget_gives_the_run_that_had_it_from_the_beginning(copy, tmp_path):
    larger = run(tmp_path / "larger", *SMALL, "--budget", "150")
    grammarbt("resume", str(copy), "--budget", "150")
    assert journal(copy) == journal(larger)
    grammarbt("resume", str(copy))
    assert journal(copy) == journal(larger)


def rewrite_resolved(folder, change):
    resolved = dict(RunFolder(folder).read_resolved())
    change(resolved)
    RunFolder(folder).save_resolved(resolved)


def test_other_versions_are_one_line_of_warning(copy, capsys):
    rewrite_resolved(copy, lambda resolved: resolved["versions"].update(numpy="0.1"))
    grammarbt("resume", str(copy))
    (line,) = capsys.readouterr().err.splitlines()
    assert "numpy 0.1 then" in line


def test_a_searcher_that_proposes_otherwise_is_an_error_naming_the_trial(copy, capsys):
    before = journal(copy)
    rewrite_resolved(copy, lambda resolved: (resolved["spec"].update(seed=4), resolved.update(seed=4)))
    assert main(["resume", str(copy), "--quiet"]) == 2
    first = read_journal(copy / "journal.jsonl")[0]["tree"]
    assert f"line 1: trial 1 was {first} on the scenarios 0 to 1" in capsys.readouterr().err
    assert journal(copy) == before


def test_a_changed_grammar_is_named(copy, capsys):
    rewrite_resolved(copy, lambda resolved: resolved["grammar"].update(fingerprint="other"))
    assert main(["resume", str(copy), "--quiet"]) == 2
    assert "the grammar of" in capsys.readouterr().err


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
    command = [sys.executable, "-m", "grammarbt", "run", *SMALL, "--budget", "60", "--quiet", "--out", str(folder)]
    full = f"ulimit -f {len(journal(finished)) // 2048} && exec {shlex.join(command)}"  # in blocks of 1,024 bytes
    done = subprocess.run(["/bin/bash", "-c", full], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "cannot write" in done.stderr.splitlines()[0]
    grammarbt("resume", str(folder))
    assert journal(folder) == journal(finished)


def test_a_run_of_workers_is_resumed_by_workers(finished, tmp_path):
    folder = run(tmp_path / "run", *SMALL, "--budget", "60", "--workers", "2")
    whole = journal(folder)
    assert whole == journal(finished)
    (folder / "journal.jsonl").write_bytes(whole[: len(whole) // 2])
    grammarbt("resume", str(folder))
    assert journal(folder) == whole


def test_workers_and_executor_may_change_and_the_bytes_do_not(finished, copy):
    whole = journal(finished)
    for options in (("--workers", "2"), ("--executor", "processes"), ("--workers", "1", "--executor", "serial")):
        (copy / "journal.jsonl").write_bytes(whole[: len(whole) // 3])
        grammarbt("resume", str(copy), *options)
        assert journal(copy) == whole


def test_settings_of_one_executor_do_not_follow_to_another(finished, tmp_path):
    limit = ("--workers", "2", "--set", "executor.timeout=9")
    folder = run(tmp_path / "run", *SMALL, "--budget", "60", *limit)
    (folder / "journal.jsonl").write_bytes(journal(finished)[:900])
    grammarbt("resume", str(folder), "--workers", "1", "--executor", "serial")
    assert journal(folder) == journal(finished)


def test_only_the_executor_takes_settings(copy, capsys):
    assert main(["resume", str(copy), "--set", "searcher.c=1"]) == 2
    assert "executor" in capsys.readouterr().err


def test_a_run_with_relative_paths_goes_on_from_another_directory(tmp_path, monkeypatch):
    there, elsewhere = tmp_path / "there", tmp_path / "elsewhere"
    there.mkdir()
    elsewhere.mkdir()
    shutil.copy(CORRIDOR.partition(":")[0], there / "mine.py")
    (there / "start.tree").write_text("?( →( (holding cup) [go to door] ) →( [go to cup] [grasp] ) )")
    monkeypatch.chdir(there)
    relative = ("--domain", "mine.py:Corridor", "--start", "start.tree", *SMALL[2:], "--budget", "60")
    whole = journal(run("run", *relative) and there / "run")
    (there / "run" / "journal.jsonl").write_bytes(whole[: len(whole) // 2])
    monkeypatch.chdir(elsewhere)
    grammarbt("resume", "../there/run")
    assert journal(there / "run") == whole
    assert Path.cwd() == elsewhere


def test_a_domain_file_that_was_edited_is_one_line_of_warning(tmp_path, capsys):
    file = tmp_path / "mine.py"
    shutil.copy(CORRIDOR.partition(":")[0], file)
    folder = run(tmp_path / "run", "--domain", f"{file}:Corridor", *SMALL[2:], "--budget", "60")
    capsys.readouterr()
    file.write_text(file.read_text(encoding="utf-8") + "\n# a thought\n", encoding="utf-8")
    grammarbt("resume", str(folder))
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("warning: versions differ")
    assert str(file) in line


def test_the_clock_of_a_run_counts_on(tmp_path):
    folder = run(tmp_path / "run", *SMALL, "--budget", "60", "--seconds", "1000")
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


def damage(data, content):
    """The content with bytes changed, or lines lost, doubled or moved."""
    lines = content.splitlines(keepends=True)
    one, two = (data.draw(st.integers(0, len(lines) - 1)) for _ in range(2))
    kind = data.draw(st.sampled_from(["byte", "cut", "insert", "lose", "double", "swap"]))
    place = data.draw(st.integers(0, len(content) - 1))
    if kind == "byte":
        return content[:place] + data.draw(st.binary(min_size=1, max_size=1)) + content[place + 1 :]
    if kind == "cut":
        return content[:place]
    if kind == "insert":
        return content[:place] + data.draw(st.binary(max_size=5)) + content[place:]
    if kind == "lose":
        return b"".join(lines[:one] + lines[one + 1 :])
    if kind == "double":
        return b"".join([*lines[: one + 1], *lines[one:]])
    lines[one], lines[two] = lines[two], lines[one]
    return b"".join(lines)


@settings(max_examples=80, deadline=None)
@given(data=st.data())
def test_a_damaged_run_is_an_error_with_its_place_or_resumed_correctly(finished, data):
    name = data.draw(st.sampled_from(["journal.jsonl", "run.json", "spec.toml", "timing.jsonl", "best.tree"]))
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(shutil.copytree(finished, Path(scratch) / "run"))
        (folder / name).write_bytes(damage(data, (folder / name).read_bytes()))
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
            code = main(["resume", str(folder), "--quiet"])
        if code == 0:
            assert journal(folder) == journal(finished)
        else:
            assert code == 2
            assert f"{folder}/{name}" in errors.getvalue().splitlines()[0]
