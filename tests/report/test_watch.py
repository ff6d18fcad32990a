"""`grammarbt watch`: a run followed from its folder."""

import subprocess
import sys
from io import StringIO
from math import isfinite

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

from grammarbt.bt import parse
from grammarbt.cli import main
from grammarbt.cli.drawing import drawing
from grammarbt.cli.watch import view
from grammarbt.report.following import Follower
from grammarbt.report.history import read_history
from grammarbt.report.sparkline import course, sparkline


def test_a_journal_that_grows_is_read_to_the_same_history(run):
    journal = run / "journal.jsonl"
    whole = journal.read_bytes()
    journal.write_bytes(b"")
    follower = Follower(run)
    for end in (0, 1, 700, 701, len(whole) // 2, len(whole) - 1, len(whole)):
        journal.write_bytes(whole[:end])  # mostly torn in the middle of a line
        assert follower.look() == read_history(run)
    assert follower.look().finished


def test_a_journal_that_was_cut_is_read_anew(run):
    follower, journal = Follower(run), run / "journal.jsonl"
    assert follower.look().finished
    journal.write_bytes(b"".join(journal.read_bytes().splitlines(keepends=True)[:40]))
    assert follower.look() == read_history(run)


def test_watching_ends_when_another_process_finishes_the_run(run, tmp_path, rooms):
    folder = tmp_path / "fresh"
    command = [sys.executable, "-m", "grammarbt"]
    arguments = ["--domain", f"{rooms}:Rooms", "--searcher", "random", "--budget", "20000", "--validation", "50"]
    with subprocess.Popen(
        [*command, "run", *arguments, "--out", str(folder), "--quiet"], stdout=subprocess.DEVNULL
    ) as made:
        while not (folder / "journal.jsonl").exists():
            assert made.poll() is None
        watched = subprocess.run(
            [*command, "watch", str(folder)], capture_output=True, text=True, check=True, timeout=120
        )
        assert made.wait() == 0
    *lines, last = watched.stdout.splitlines()
    assert lines
    assert all("of 20,000 episodes" in line for line in lines)
    assert "found a tree" in last


def test_once_says_where_a_run_is_and_ends(run, capsys):
    journal = run / "journal.jsonl"
    journal.write_bytes(b"".join(journal.read_bytes().splitlines(keepends=True)[:40]))
    assert main(["watch", str(run), "--once"]) == 0
    assert f"{read_history(run).episodes} of 300 episodes" in capsys.readouterr().out


def test_the_view_shows_curve_tree_and_speed(made_run):
    history = read_history(made_run)
    console = Console(width=100, record=True, file=StringIO())
    console.print(view(history, 1234.0))
    shown = console.export_text()
    assert "1,234 episodes/s" in shown
    assert "█" in shown
    assert all(line in shown for line in drawing(parse(history.improvements[-1].tree)))


def test_watching_what_is_no_run_is_refused(tmp_path, capsys):
    assert main(["watch", str(tmp_path)]) == 2
    assert "give the folder of a run" in capsys.readouterr().err


@given(st.lists(st.floats(-1e300, 1e300) | st.just(float("inf")) | st.just(float("nan"))), st.integers(1, 40))
def test_a_sparkline_is_never_wider_than_asked_and_shows_low_and_high(values, width):
    text = sparkline(values, width)
    assert len(text) <= width
    known = {value for value in values if isfinite(value)}
    if len(known) > 1 and len(values) <= width and len(known) == len(set(values)):
        assert {"▁", "█"} <= set(text)


@pytest.mark.parametrize(("until", "shown"), [(10, "▁▁▁▁▁▁▁▁▁█"), (20, "▁▁▁▁▁█████")])
def test_a_course_stays_where_it_was_until_the_next_step(until, shown):
    assert course([(0, 1.0), (10, 2.0)], until, 10) == shown
