"""A bench runs every cell once, goes on where it stopped, and says what it found in four formats."""

import csv
import importlib.util
import json
import shutil
from pathlib import Path

import pytest

from grammarbt.cli import main

WORLDS = Path(importlib.util.find_spec("grammarbt.testing.worlds").origin)
SPEC = f"""
budget = 120
seeds = [100, 103]
validation = 50
curve = 20
workers = 2
[[searcher]]
name = "random"
[[searcher]]
name = "dagmcts"
set = {{ first_trees = 10 }}
[[domain]]
name = "{WORLDS}:Lamps"
label = "lamps"
"""


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bench")
    (folder / "small.toml").write_text(SPEC, encoding="utf-8")
    assert main(["bench", str(folder / "small.toml")]) == 0
    return folder


def test_table_has_a_row_per_searcher_and_a_line_per_pair(bench):
    found = json.loads((bench / "small/table.json").read_text())
    assert [(row["searcher"], row["runs"]) for row in found["rows"]] == [("random", 3), ("dagmcts(first_trees=10)", 3)]
    assert [(pair["first"], pair["second"]) for pair in found["pairs"]] == [("random", "dagmcts(first_trees=10)")]
    for row in found["rows"]:
        assert row["value"]["low"] <= row["value"]["value"] <= row["value"]["high"]
        assert row["worst"] <= row["value"]["value"]


def test_values_are_those_that_the_runs_report(bench):
    with (bench / "small/table.csv").open(newline="") as file:
        rows = {row["searcher"]: row for row in csv.DictReader(file)}
    journals = sorted((bench / "small/lamps/random").glob("s*/journal.jsonl"))
    assert len(journals) == 3
    best = [
        event["mean"]
        for journal in journals
        for event in map(json.loads, journal.read_text().splitlines())
        if event["event"] == "validation" and event["name"] == "best"
    ]
    assert float(rows["random"]["worst"]) == min(best)


def test_interrupted_bench_goes_on_and_ends_with_the_same_table(bench, capsys):
    before = (bench / "small/table.json").read_text()
    shutil.rmtree(bench / "small/lamps/random/s101")
    journal = bench / "small/lamps/random/s102/journal.jsonl"
    journal.write_bytes(b"".join(journal.read_bytes().splitlines(keepends=True)[:30]))
    assert main(["bench", str(bench / "small.toml"), "--json"]) == 0
    captured = capsys.readouterr()
    assert "4 of 6 runs are there already" in captured.err
    assert captured.out == before == (bench / "small/table.json").read_text()


def test_curves_are_drawn_as_text_and_lines(bench):
    picture = (bench / "small/curves.svg").read_text()
    assert "lamps" in picture
    assert "reference" in picture


def test_compare_puts_the_same_runs_side_by_side(bench, capsys):
    runs = [str(path) for path in sorted((bench / "small/lamps").glob("*/s*"))]
    assert main(["compare", *runs, "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    known = json.loads((bench / "small/table.json").read_text())["rows"]
    assert {row["worst"] for row in rows} == {row["worst"] for row in known}


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("budgets = 3", "did you mean 'budget'?"),
        ("[[searcher]]\nname='random'\n[[searcher]]\nname='random'\n[[domain]]\nname='ant'", "title of its own"),
        ("[[searcher]]\nnme='random'\n[[domain]]\nname='ant'", "nme"),
        ("budget = 3", "searcher"),
        ("= 3", "is not TOML"),
    ],
)
def test_mistakes_in_the_spec_are_told_in_one_line(text, complaint, tmp_path, capsys):
    (tmp_path / "x.toml").write_text(text, encoding="utf-8")
    assert main(["bench", str(tmp_path / "x.toml")]) == 2
    error = capsys.readouterr().err
    assert complaint in error
    assert "Traceback" not in error


def test_run_that_fails_is_named_and_the_others_go_on(tmp_path, capsys):
    spec = SPEC.replace("first_trees = 10", "first_tree = 10").replace("[100, 103]", "[100, 101]")
    (tmp_path / "bad.toml").write_text(spec, encoding="utf-8")
    assert main(["bench", str(tmp_path / "bad.toml"), "--json"]) == 1
    captured = capsys.readouterr()
    assert "first_tree" in captured.err
    assert [row["searcher"] for row in json.loads(captured.out)["rows"]] == ["random"]
