"""`grammarbt report`: a page about runs, which needs nothing else."""

import json
import re
import shlex
import shutil
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path

import pytest

from grammarbt.cli import main
from grammarbt.report.evidence import Evidence
from grammarbt.report.history import Failure, History, Improvement, Measured, read_history
from grammarbt.report.origin import command_of
from grammarbt.report.single import sentence, single_report
from grammarbt.run.folder import RunFolder

HOSTILE = "<img src=x onerror=alert`1`>"
SECTIONS = ("tree", "curve", "changes", "subtrees", "nodes", "search", "failures", "origin")


class Page(HTMLParser):
    """Tags, anchors and text of a page."""

    def __init__(self, html):
        super().__init__()
        self.tags, self.ids, self.links, self.text = Counter(), [], [], []
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        self.tags[tag] += 1
        self.ids += [value for name, value in attrs if name == "id"]
        self.links += [value for name, value in attrs if name in ("src", "href")]

    def handle_data(self, data):
        self.text.append(data)


def report(*arguments):
    assert main(["report", *map(str, arguments)]) == 0


@pytest.fixture(scope="module")
def page(made_run):
    report(made_run, "--episodes", "30")
    return (made_run / "report.html").read_text(encoding="utf-8")


def history(run, **changes):
    """A history made up but for its `run.json`."""
    tree = f"?( ({HOSTILE}) [x] )"
    values = {
        "folder": run, "resolved": RunFolder(run).read_resolved(),
        "improvements": (Improvement(1, 1, tree, 0.5),), "statuses": {"ok": 1, "failed": 1},
        "failures": (Failure(2, tree, "failed", "<script>alert(1)</script>"),), "trials": 2, "episodes": 2,
        "stopped": "budget", "validations": (Measured("best", tree, 2.0, 0.1, 9), Measured(HOSTILE, tree, 4.0, 0.1, 9)),
        "complete": None, "finished": True,
    }  # fmt: skip
    return History(**(values | changes))


def test_the_page_has_every_section_and_loads_nothing(page):
    seen = Page(page)
    assert [name for name in seen.ids if name in SECTIONS] == list(SECTIONS)
    assert seen.tags["script"] == seen.tags["link"] == 0
    assert not seen.links
    assert "url(" not in page
    assert "@import" not in page


def test_headings_landmarks_and_language_are_there(page):
    seen = Page(page)
    assert (seen.tags["h1"], seen.tags["main"], seen.tags["h2"]) == (1, 1, len(SECTIONS))
    assert '<html lang="en">' in page


def test_the_result_stands_in_one_sentence(made_run, page):
    found = read_history(made_run)
    text = sentence(found)
    assert text in "".join(Page(page).text)
    for part in (f"{found.best.mean:.5g}", f"{found.reference.mean:.5g}", f"{found.ratio:.1%}"):
        assert part in text


def test_every_node_of_the_best_tree_has_its_visits(made_run, page):
    rows = re.search(r"Node by node</caption>.*?</table>", page, re.DOTALL)[0]
    tree = read_history(made_run).best.tree
    assert Page(rows).tags["tr"] == 1 + len(
        re.findall(r"[?→‖!]|\[|\((?=[^ ])", tree.replace("!(", "! ").replace("( ", " "))
    )


def test_the_command_makes_the_run_again(made_run, tmp_path):
    command = shlex.split(command_of(read_history(made_run)))
    assert command[:2] == ["grammarbt", "run"]
    assert main([*command[1:], "--out", str(tmp_path / "again"), "--quiet"]) == 0
    assert (tmp_path / "again" / "journal.jsonl").read_bytes() == (made_run / "journal.jsonl").read_bytes()


def test_a_domain_that_is_gone_leaves_out_what_needs_it_and_says_why(run, tmp_path, capsys):
    resolved = json.loads((run / "run.json").read_text())
    gone = tmp_path / "gone.py"
    shutil.copy(resolved["domain"]["name"].rpartition(":")[0], gone)
    assert main(["run", "--domain", f"{gone}:Rooms", "--searcher", "random", "--budget", "50", "--validation", "20",
                 "--out", str(tmp_path / "r"), "--quiet"]) == 0  # fmt: skip
    gone.unlink()
    report(tmp_path / "r")
    text = "".join(Page((tmp_path / "r" / "report.html").read_text(encoding="utf-8")).text)
    assert text.count(f"there is no file {gone}") == 3
    assert "Means in the search, which flatter" in text


def test_with_every_plugin_off_the_report_of_its_domains_run_is_written(run, tmp_path):
    resolved = RunFolder(run).read_resolved()
    broken = {**resolved, "domain": {"name": "not installed", "parameters": {}}}
    RunFolder(run).save_resolved(broken)
    report(run, "--no-plugin", "all", "-o", tmp_path / "page.html")
    assert "unknown domain" in (tmp_path / "page.html").read_text(encoding="utf-8")


def test_names_trees_and_errors_cannot_bring_elements_into_the_page(made_run):
    seen = Page(single_report(history(made_run), Evidence(0, missing=HOSTILE)))
    assert seen.tags["img"] == seen.tags["script"] == 0
    text = "".join(seen.text)
    assert text.count(HOSTILE) > 5
    assert "<script>alert(1)</script>" in text


def test_a_run_without_a_tree_says_so(made_run):
    empty = history(made_run, improvements=(), validations=(), finished=False, stopped=None)
    assert "has not found a tree yet" in single_report(empty, Evidence(0, missing="no tree"))


def test_a_million_trials_stay_under_five_megabytes(made_run, tmp_path):
    leaves = " ".join(f"[action number {at}]" for at in range(100))
    steps = tuple(Improvement(at, at, f"?( (c{at}) {leaves} )", float(at)) for at in range(1, 100_000))
    many = history(made_run, folder=tmp_path, improvements=steps, trials=1_000_000)
    lines = [
        {"batch": 1, "episodes": 9, "seconds": at / 10, "metrics": {"nodes": at, "depth": 2.0}} for at in range(20_000)
    ]
    (tmp_path / "timing.jsonl").write_text("\n".join(map(json.dumps, lines)), encoding="utf-8")
    assert len(single_report(many, Evidence(0, missing="nothing was simulated")).encode()) < 5_000_000


def test_metrics_of_the_searcher_are_shown(run):
    line = {"batch": 1, "episodes": 300, "seconds": 1.0, "metrics": {"restarts": 17.0}}
    (run / "timing.jsonl").write_text(json.dumps(line) + "\n", encoding="utf-8")
    report(run, "--episodes", "0")
    page = (run / "report.html").read_text(encoding="utf-8")
    assert "restarts" in page
    assert f"{read_history(run).episodes:,} episodes a second" in page


def test_a_run_writes_its_searchers_metrics_to_the_timing(tmp_path, rooms):
    arguments = ["--domain", f"{rooms}:Rooms", "--searcher", "dagmcts", "--budget", "60", "--validation", "20"]
    assert main(["run", *arguments, "--out", str(tmp_path / "run"), "--quiet"]) == 0
    last = json.loads((tmp_path / "run" / "timing.jsonl").read_text().splitlines()[-1])
    assert last["metrics"]


def test_several_runs_share_a_chart_and_a_table(made_run, run, tmp_path):
    report(made_run, run, "--episodes", "20", "-o", tmp_path / "both.html")
    seen = Page((tmp_path / "both.html").read_text(encoding="utf-8"))
    assert {"curves", "statistics", "runs", "trees"} <= set(seen.ids)
    assert "2 of 2 runs have finished" in "".join(seen.text)


@pytest.mark.parametrize(("suffix", "start"), [(".svg", b"<?xml"), (".pdf", b"%PDF"), (".png", b"\x89PNG")])
def test_the_suffix_decides_how_curves_are_drawn(made_run, tmp_path, suffix, start):
    path = tmp_path / f"curves{suffix}"
    report(made_run, "--episodes", "20", "-o", path)
    assert path.read_bytes().startswith(start)


def test_another_suffix_is_refused_in_one_line(made_run, tmp_path, capsys):
    assert main(["report", str(made_run), "-o", str(tmp_path / "curves.doc")]) == 2
    assert "end it in .html" in capsys.readouterr().err


def test_a_folder_without_a_run_is_refused(tmp_path, capsys):
    assert main(["report", str(tmp_path)]) == 2
    assert capsys.readouterr().err.startswith("error: cannot read")
    assert not list(Path(tmp_path).iterdir())
