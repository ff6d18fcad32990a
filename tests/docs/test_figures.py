"""Tables on pages that follow from the code say what the code says."""

import re
import subprocess
import sys

import pytest
from pages import ROOT

from grammarbt.bt import flatten, format_leaf, parse
from grammarbt.cli import main
from grammarbt.plugins import PluginHost, PluginOptions
from grammarbt.report.tables import HEAD, PAIR_HEAD
from grammarbt.run.journal import iterate_journal

DOCS = ROOT / "docs"
CORRIDOR = f"{ROOT / 'docs/examples/corridor.py'}:Corridor"
START = "?( →( [go to cup] [grasp] ) →( (holding cup) [go to door] ) )"
BEGINS = ("annealing", "compose", "dagmcts", "exhaustive", "ge", "gp", "qlearning", "random", "uct")


def rows(page, columns):
    """The cells of every row of so many columns."""
    text = (DOCS / page).read_text(encoding="utf-8")
    found = re.findall(r"^\| (.*) \|$", text, re.MULTILINE)
    return [cells for cells in (row.split(" | ") for row in found) if len(cells) == columns]


def test_the_savings_of_common_worlds_are_what_the_benchmark_prints():
    command = [sys.executable, str(ROOT / "benchmarks/paired.py"), "--scenarios", "1000"]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    measured = [line.split()[1:] for line in printed.splitlines() if line.endswith("×")]
    on_page = [[*cells[1:4], cells[4].replace(" ", "")] for cells in rows("explanation/racing.md", 5)[2:]]
    assert on_page == measured


def recorded():
    """What is on record for the marine default: searcher, episodes, seeds, complete, mean, interval, worst."""
    found = rows("../benchmarks/results/marine.md", 8)
    return [[searcher.strip("`"), *figures] for searcher, preset, *figures in found if preset == "default"]


def test_marine_figures_in_the_readme_are_those_on_record():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    shown = [re.split(r"  +", line) for line in re.findall(r"^ {4}(\w+ +\d+–\d+ .* – .*)$", text, re.MULTILINE)]
    record = [[searcher, seeds, episodes, *figures] for searcher, episodes, seeds, *figures in recorded()]
    assert shown
    assert [row for row in shown if row not in without_grouping(record)] == []


def without_grouping(record):
    """As commands print figures: no comma, and a zero before the point."""
    return [[re.sub(r"(?<!\d)\.", "0.", cell.replace(",", "")) for cell in row] for row in record]


def test_marine_figures_of_the_default_searchers_are_those_on_record():
    shown = [[cells[0].strip("`"), *cells[1:]] for cells in rows("explanation/dagmcts.md", 6) if cells[0][0] == "`"]
    record = [[searcher, episodes, *figures] for searcher, episodes, _, *figures in recorded()]
    assert shown
    assert [row for row in shown if row not in record] == []


def test_marine_figures_beside_the_paper_s_are_those_on_record():
    (_, *budgets, _), _, *shown = rows("explanation/method.md", 5)
    record = {(searcher, episodes, mean, complete) for searcher, episodes, _, complete, mean, *_ in recorded()}
    for searcher, *means, complete in shown:
        for budget, mean in zip(budgets, means, strict=True):
            known = [row for row in record if row[:3] == (searcher.strip("`"), budget, mean)]
            assert known or mean == "–", (searcher, budget)
        assert complete in {row[3] for row in known} or complete == "–", searcher


def test_times_of_tutorials_are_those_on_record():
    record = {cells[0]: cells[2] for cells in rows("../benchmarks/results/tutorials.md", 6)}
    text = (DOCS / "index.md").read_text(encoding="utf-8")
    shown = dict(re.findall(r"\(tutorials/([\w-]+)\.md\).* \| (\d+) s \|$", text, re.MULTILINE))
    assert shown == {path.stem: record[path.stem] for path in (DOCS / "tutorials").glob("*.md")}


def test_the_table_of_a_compiled_tree_is_the_compiler_s():
    results = {-1: "SUCCESS", -2: "FAILURE", -3: "RUNNING"}
    entries = flatten(parse("?( (a) →( (b) [c] ) )")).entries
    compiled = [
        [str(at), f"`{format_leaf(entry.leaf)}`"]
        + [results.get(after, str(after)) for after in (entry.on_success, entry.on_failure)]
        for at, entry in enumerate(entries)
    ]
    assert [cells for cells in rows("explanation/ticks.md", 4) if cells[0].isdigit()] == compiled


def test_the_columns_of_comparisons_are_explained():
    explained = {name for cells in rows("how-to/compare.md", 2) for name in re.findall(r"^`(.*)`$", cells[0])}
    plain = {"domain", "searcher", "runs", "first", "second"}
    assert explained == {*HEAD, *PAIR_HEAD} - plain


def test_the_page_on_warm_starts_names_every_searcher():
    named = {name for cells in rows("how-to/warm-start.md", 2) for name in re.findall(r"`(\w+)`", cells[0])}
    plugins = PluginHost(PluginOptions(), lambda _: None).plugins
    known = {spec.name for plugin in plugins for spec in plugin.provides["searchers"]}
    assert named & known == known == set(BEGINS)


def trees_of_a_run(folder, *options):
    assert main(["run", "--domain", CORRIDOR, "--budget", "60", "--validation", "4", "--quiet", "--out", str(folder),
                 *options]) == 0  # fmt: skip
    events = iterate_journal(folder / "journal.jsonl")
    return [event["tree"] for event in events if event["event"] == "trial"]


@pytest.mark.parametrize("searcher", [*BEGINS, "dagmcts --set searcher.preset=paper"])
def test_a_search_begins_with_the_start_tree(searcher, tmp_path, capsys):
    trees = trees_of_a_run(tmp_path / "run", "--searcher", *searcher.split(), "--start", START)
    assert START in trees[:2]
