"""The page on file formats lists what the files hold."""

import json
import re
import tomllib
from pathlib import Path

from attrs import fields
from pages import ROOT, blocks

from grammarbt.cli import main
from grammarbt.run.bench import BenchSpec, Contestant
from grammarbt.run.folder import RunFolder
from grammarbt.run.journal import read_journal
from grammarbt.run.spec import PARTS, RunSpec

PAGE = (ROOT / "docs/reference/formats.md").read_text(encoding="utf-8")
SPEC, BENCH = (tomllib.loads(block.text) for block in blocks(PAGE) if block.language == "toml")


def names(cls):
    return [attribute.name for attribute in fields(cls)]


def test_a_runs_spec_is_complete():
    assert sorted(SPEC) == sorted(names(RunSpec))
    assert list(SPEC["set"]) == list(PARTS)
    assert RunSpec(**SPEC)


def test_a_benchs_spec_is_complete():
    assert sorted(BENCH) == sorted(names(BenchSpec))
    assert sorted({*BENCH["searcher"][0], *BENCH["domain"][0]}) == sorted(names(Contestant))
    assert BenchSpec(**BENCH)


def test_defaults_on_the_page_are_those_of_the_code():
    given = {name: SPEC[name] for name in ("budget", "seed", "batch", "workers", "validation", "selection", "snapshot")}
    assert given == {name: getattr(RunSpec(), name) for name in given}


def test_a_runs_files_and_events_are_those_on_the_page(tmp_path):
    corridor = f"{ROOT / 'docs/examples/corridor.py'}:Corridor"
    run = tmp_path / "run"
    assert main(["run", "--domain", corridor, "--searcher", "random", "--budget", "40", "--validation", "10",
                 "--quiet", "--out", str(run)]) == 0  # fmt: skip
    assert {path.name for path in run.iterdir()} <= set(re.findall(r"`([a-z]+\.[a-z]+)`", PAGE))
    rows = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", PAGE, re.MULTILINE))
    for event in read_journal(RunFolder(run).journal):
        row = rows["trial"] if event["event"] == "selection" else rows[event["event"]]
        assert set(event) - {"event"} <= set(re.findall(r"`(\w+)`", row))
    resolved = json.loads((run / "run.json").read_text(encoding="utf-8"))
    listed = re.search(r"`run.json` \| (.*) \|", PAGE)[1]
    assert set(resolved) - {"crc"} <= set(re.findall(r"`(\w+)`", listed))
    timing = json.loads(Path(run / "timing.jsonl").read_text(encoding="utf-8").splitlines()[0])
    assert set(timing) <= set(re.findall(r"`(\w+)`", re.search(r"`timing.jsonl` \| (.*) \|", PAGE)[1]))
