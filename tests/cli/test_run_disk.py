"""Folders that cannot be written and disks that are full: one line, and what was saved stays."""

import os
import shlex
import shutil
import subprocess
import sys

import pytest
from corridor_runs import CORRIDOR, CORRIDOR_FILE

from grammarbt.cli import main
from grammarbt.run.journal import read_journal

RUN = ("run", "--searcher", "random", "--budget", "300", "--validation", "20", "--quiet")
NOBODY = 65534


def in_a_shell(before, *arguments):
    """The command line in a process of its own, after a shell's command."""
    line = shlex.join([sys.executable, "-m", "grammarbt", *arguments, "--domain", CORRIDOR])
    return subprocess.run(["/bin/bash", "-c", f"{before}; exec {line}"], capture_output=True, text=True, check=False)


def one_line(errors):
    lines = errors.splitlines()
    assert [line.partition(":")[0] for line in lines] == ["error", "hint"]
    return lines[0]


@pytest.fixture
def locked_run(tmp_path):
    """A run in a folder that may be read and not written, also by root, who becomes nobody meanwhile."""
    shutil.copy(CORRIDOR_FILE, tmp_path / "mine.py")
    folder = tmp_path / "run"
    domain = ("--domain", f"{tmp_path / 'mine.py'}:Corridor")
    assert main([*RUN, *domain, "--out", str(folder)]) == 0
    assert main(["resume", str(folder), "--quiet"]) == 0  # so that all is imported that nobody may not read
    for path in folder.iterdir():
        path.chmod(0o444)
    folder.chmod(0o555)
    if os.geteuid() != 0:
        yield folder
        folder.chmod(0o755)
        return
    for parent in list(folder.parents)[:-2]:
        parent.chmod(parent.stat().st_mode | 0o055)
    os.seteuid(NOBODY)
    yield folder
    os.seteuid(0)


def test_a_run_that_may_not_be_written_is_one_line_and_stays_as_it_is(locked_run, capsys):
    before = (locked_run / "journal.jsonl").read_bytes()
    capsys.readouterr()
    assert main(["resume", str(locked_run), "--quiet"]) == 2
    assert "journal.jsonl': Permission denied" in one_line(capsys.readouterr().err)
    assert (locked_run / "journal.jsonl").read_bytes() == before


@pytest.mark.parametrize("blocks", [1, 8])  # of 1,024 bytes: too little for run.json, and for some trials
def test_a_disk_that_is_full_is_one_line_and_loses_nothing_written(tmp_path, blocks):
    folder = tmp_path / "run"
    done = in_a_shell(f"ulimit -f {blocks}", *RUN, "--out", str(folder))
    assert done.returncode == 2
    assert "cannot write" in one_line(done.stderr)
    assert not list(folder.glob("*.new"))
    if not (folder / "run.json").exists():
        return
    events = read_journal(folder / "journal.jsonl")
    assert len(events) >= blocks  # a trial takes less than a block
    assert main(["resume", str(folder), "--quiet"]) == 0
    assert read_journal(folder / "journal.jsonl")[: len(events)] == events


def test_a_full_standard_output_is_one_line_and_the_run_is_whole(tmp_path):
    done = in_a_shell("exec >/dev/full", *RUN, "--json", "--out", str(tmp_path / "run"))
    assert done.returncode == 2
    assert done.stderr == "error: output: No space left on device\n"
    assert read_journal(tmp_path / "run" / "journal.jsonl")[-1]["event"] == "finished"
