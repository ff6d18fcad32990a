"""Runs that go on with other workers, from another directory, or with another file of the domain."""

import shutil
from pathlib import Path

from corridor_runs import CORRIDOR_FILE, IN_CORRIDOR, SMALL, grammarbt, journal, run

from grammarbt.cli import main


def test_a_run_of_workers_is_resumed_by_workers(finished, tmp_path):
    folder = run(tmp_path / "run", *IN_CORRIDOR, "--budget", "60", "--workers", "2")
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
    folder = run(tmp_path / "run", *IN_CORRIDOR, "--budget", "60", *limit)
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
    shutil.copy(CORRIDOR_FILE, there / "mine.py")
    (there / "start.tree").write_text("?( →( (holding cup) [go to door] ) →( [go to cup] [grasp] ) )")
    monkeypatch.chdir(there)
    relative = ("--domain", "mine.py:Corridor", "--start", "start.tree", *SMALL, "--budget", "60")
    whole = journal(run("run", *relative) and there / "run")
    (there / "run" / "journal.jsonl").write_bytes(whole[: len(whole) // 2])
    monkeypatch.chdir(elsewhere)
    grammarbt("resume", "../there/run")
    assert journal(there / "run") == whole
    assert Path.cwd() == elsewhere


def test_a_domain_file_that_was_edited_is_one_line_of_warning(tmp_path, capsys):
    file = tmp_path / "mine.py"
    shutil.copy(CORRIDOR_FILE, file)
    folder = run(tmp_path / "run", "--domain", f"{file}:Corridor", *SMALL, "--budget", "60")
    capsys.readouterr()
    file.write_text(file.read_text(encoding="utf-8") + "\n# a thought\n", encoding="utf-8")
    grammarbt("resume", str(folder))
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("warning: versions differ")
    assert str(file) in line
