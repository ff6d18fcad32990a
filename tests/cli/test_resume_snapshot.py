"""Snapshots shorten a replay and change nothing else."""

import json

import pytest
from corridor_runs import IN_CORRIDOR, grammarbt, journal, run

from grammarbt.run import snapshot
from grammarbt.run.folder import read_sealed, save_sealed
from grammarbt.search.random import RandomSearch


@pytest.fixture
def snapped(tmp_path, monkeypatch):
    """A run that made a snapshot after every batch, cut off in its selection, and its whole journal."""
    monkeypatch.setattr(snapshot, "SHARE", float("inf"))
    spec = tmp_path / "spec.toml"
    spec.write_text("snapshot = 0.0\nbudget = 200\n")
    folder = run(tmp_path / "snapped", str(spec), *IN_CORRIDOR)
    whole = journal(folder)
    (folder / "journal.jsonl").write_bytes(whole[: len(whole) - 900])
    return folder, whole


def position(folder):
    return json.loads((folder / "snapshot.json").read_text(encoding="utf-8"))["position"]


def test_a_snapshot_shortens_the_replay_and_gives_the_same_bytes(snapped, monkeypatch):
    folder, whole = snapped
    begun = position(folder)["events"]
    asked = []
    ask = RandomSearch.ask
    monkeypatch.setattr(RandomSearch, "ask", lambda self, n: asked.append(n) or ask(self, n))
    grammarbt("resume", str(folder))
    assert journal(folder) == whole
    assert begun > 100
    assert sum(asked) < 50
    (folder / "snapshot.json").unlink()
    (folder / "journal.jsonl").write_bytes(whole[: len(whole) - 900])
    grammarbt("resume", str(folder))
    assert journal(folder) == whole
    assert sum(asked) > 150


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (lambda state: state.pop("tally"), "damaged"),
        (lambda state: state["versions"].update(numpy="0.1"), "other versions"),
        (lambda state: state["position"].update(events=3), "does not belong"),
        (lambda state: state["position"].update(size=10**9, events=10**6), "does not belong"),
    ],
)
def test_a_snapshot_that_cannot_be_used_is_ignored_with_a_warning(snapped, capsys, change, reason):
    folder, whole = snapped
    capsys.readouterr()
    state = dict(read_sealed(folder / "snapshot.json"))
    change(state)
    save_sealed(folder / "snapshot.json", state)
    grammarbt("resume", str(folder))
    (line,) = capsys.readouterr().err.splitlines()
    assert reason in line
    assert journal(folder) == whole


def test_a_snapshot_that_outlived_its_journal_is_ignored(snapped, capsys):
    folder, whole = snapped
    (folder / "journal.jsonl").write_bytes(whole[:2000])
    grammarbt("resume", str(folder))
    assert "does not belong" in capsys.readouterr().err
    assert journal(folder) == whole


def test_a_larger_budget_takes_no_notice_of_a_snapshot(snapped, tmp_path):
    folder, _ = snapped
    grammarbt("resume", str(folder), "--budget", "300")
    assert journal(folder) == journal(run(tmp_path / "larger", *IN_CORRIDOR, "--budget", "300"))
