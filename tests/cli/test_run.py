"""`grammarbt run`, as a real process on a real file."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from corridor_runs import CORRIDOR

from grammarbt.bt import parse
from grammarbt.cli import main
from grammarbt.run.journal import read_journal

COMMAND = (sys.executable, "-m", "grammarbt", "run")
FAST = ("--domain", CORRIDOR, "--searcher", "random", "--budget", "200", "--validation", "50")


def run(*arguments, hash_seed="0", cwd=None):
    environment = os.environ | {"PYTHONHASHSEED": hash_seed}
    return subprocess.run([*COMMAND, *arguments], env=environment, capture_output=True, text=True, check=False, cwd=cwd)


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A finished run: its folder and what it printed."""
    folder = tmp_path_factory.mktemp("runs") / "one"
    done = run(*FAST, "--seed", "5", "--out", str(folder), "--json", hash_seed="1")
    assert done.returncode == 0, done.stderr
    return folder, json.loads(done.stdout)


def test_the_same_seed_gives_the_same_journal_whatever_the_hash_seed(finished, tmp_path):
    folder, result = finished
    again = run(*FAST, "--seed", "5", "--out", str(tmp_path / "two"), "--json", hash_seed="2")
    assert (tmp_path / "two" / "journal.jsonl").read_bytes() == (folder / "journal.jsonl").read_bytes()
    same = json.loads(again.stdout)
    assert {**same, "run": "", "seconds": 0} == {**result, "run": "", "seconds": 0}


def test_another_seed_gives_another_journal(finished, tmp_path):
    run(*FAST, "--seed", "6", "--out", str(tmp_path / "two"))
    assert (tmp_path / "two" / "journal.jsonl").read_bytes() != (finished[0] / "journal.jsonl").read_bytes()


def test_the_journal_adds_up_to_the_episodes_reported_and_no_more_than_the_budget(finished):
    folder, result = finished
    events = read_journal(folder / "journal.jsonl")
    simulated = sum(event["simulated"] for event in events if "simulated" in event)
    assert simulated == result["episodes"] <= 200
    assert sum(event["event"] == "trial" for event in events) == result["trials"]


def test_the_json_is_the_documented_one(finished):
    folder, result = finished
    assert list(result)[:10] == [
        "run", "tree", "value", "stderr", "episodes", "trials", "seconds", "reference", "ratio", "complete",
    ]  # fmt: skip
    assert set(result["reference"]) == {"name", "value", "stderr"}
    assert result["ratio"] == pytest.approx(result["value"] / result["reference"]["value"])
    assert parse(result["tree"]) == parse((folder / "best.tree").read_text(encoding="utf-8"))


def test_the_folder_says_what_was_run(finished):
    folder, _ = finished
    resolved = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    assert resolved["seed"] == 5
    assert resolved["grammar"]["name"].startswith("scheide")
    assert "subtree" in resolved["grammar"]["text"]
    assert {"python", "numpy", "grammarbt"} <= set(resolved["versions"])


def test_the_spec_of_a_run_runs_again_to_the_same_journal(finished, tmp_path):
    folder, _ = finished
    done = run(str(folder / "spec.toml"), "--out", str(tmp_path / "two"), "--quiet")
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "two" / "journal.jsonl").read_bytes() == (folder / "journal.jsonl").read_bytes()


def test_a_run_without_out_gets_a_fresh_folder_each_time(tmp_path):
    for _ in range(2):
        assert run(*FAST, "--quiet", cwd=tmp_path).returncode == 0
    assert sorted(path.name for path in (tmp_path / "runs").iterdir()) == ["Corridor-random-s0", "Corridor-random-s0-2"]


def test_control_c_exits_with_130_and_leaves_a_readable_run(tmp_path):
    folder = tmp_path / "run"
    arguments = [*COMMAND, *FAST[:4], "--budget", "1000000", "--out", str(folder)]
    with subprocess.Popen(arguments, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + 30
        journal = folder / "journal.jsonl"
        while not (journal.exists() and journal.stat().st_size > 10_000) and time.monotonic() < deadline:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=30)
    assert process.returncode == 130
    assert output == ""
    assert "Traceback" not in errors
    assert str(folder) in errors
    events = read_journal(journal)
    assert {event["event"] for event in events} == {"trial"}
    assert parse((folder / "best.tree").read_text(encoding="utf-8")) in {parse(event["tree"]) for event in events}


def test_the_start_tree_is_tried_first(tmp_path):
    tree = "?( →( (holding cup) [go to door] ) →( [go to cup] [grasp] ) )"
    run(*FAST, "--start", tree, "--trials", "3", "--out", str(tmp_path / "run"), "--quiet")
    assert read_journal(tmp_path / "run" / "journal.jsonl")[0]["tree"] == tree


def test_stopping_rules_combine_and_the_journal_says_which_held(tmp_path):
    folder = tmp_path / "run"
    assert run(*FAST, "--stagnation", "20", "--trials", "190", "--quiet", "--out", str(folder)).returncode == 0
    events = read_journal(folder / "journal.jsonl")
    (searched,) = (event for event in events if event["event"] == "searched")
    assert searched["stopped"] == "stagnation"
    assert 20 <= searched["episodes"] < 190


def test_more_workers_than_trees_at_a_time_are_one_line_of_warning(tmp_path):
    done = run(*FAST, "--workers", "2", "--trials", "4", "--quiet", "--out", str(tmp_path / "run"))
    assert done.stderr == "warning: with --batch 1, 2 workers search no faster than 1\n"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nowhere.toml"], "nowhere.toml"),
        (["--budget", "-5"], "budget cannot be -5"),
        (["--budget", "many"], "many"),
        (["--seed", "-1"], "seed cannot be -1"),
        (["--workers", "2", "--executor", "serial"], "one worker"),
        (["--searcher", "randon"], "unknown searcher 'randon'"),
        (["--domain", "marin"], "unknown domain 'marin'"),
        (["--domain", "nowhere.py:Corridor"], "nowhere.py"),
        (["--domain", f"{CORRIDOR}s"], "no 'Corridors'"),
        (["--grammar", "nowhere.grammar"], "nowhere.grammar"),
        (["--grammar", "schiede"], "unknown grammar 'schiede'"),
        (["--start", "?( [grasp] "], "column 12"),
        (["--start", "[dance]"], "dance"),
        (["--set", "searcher.c=1"], "searcher.c"),
        (["--set", "c=1"], "cannot read the setting"),
        (["--executor", "nothing"], "unknown executor 'nothing'"),
        (["--out", "/proc/nowhere"], "/proc/nowhere"),
        (["--out", __file__], "test_run.py"),
        (["--out", str(Path(__file__).parent)], "not empty"),
    ],
)
def test_a_mistake_is_one_line_and_a_hint_and_exit_2(tmp_path, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(tmp_path)
    base = [] if arguments[0] == "--domain" else ["--domain", CORRIDOR]
    assert main(["run", "--searcher", "random", *base, *arguments]) == 2
    shown = capsys.readouterr()
    lines = shown.err.splitlines()
    assert shown.out == ""
    assert message in lines[0]
    assert [line.partition(":")[0] for line in lines] in (["error"], ["error", "hint"])
    assert list(tmp_path.iterdir()) == []
