"""The report about one run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.bt import parse
from grammarbt.report import trees
from grammarbt.report.charts import Chart, Line, Reading
from grammarbt.report.markup import Markup, element, joined, page, paragraph, section, table
from grammarbt.report.origin import origin
from grammarbt.report.sparkline import sparkline
from grammarbt.report.statistics import NORMAL_95
from grammarbt.report.thinning import thinned
from grammarbt.report.timing import read_timing
from grammarbt.run.folder import RunFolder

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grammarbt.report.evidence import Evidence
    from grammarbt.report.history import History
    from grammarbt.report.timing import Timing

_MOST_READINGS = 200
_WIDTH = 24
"""Letters of a searcher's figure over time."""


def single_report(history: History, evidence: Evidence) -> str:
    """The page."""
    sections = [
        _best(history),
        _learning(history, evidence),
        section("changes", "How the best tree changed", trees.changes(history.improvements)),
        *_inspected(history, evidence),
        _search(history),
        _failures(history),
        origin(history),
    ]
    return report_page(history.title, sentence(history), sections)


def report_page(title: str, result: str, sections: Sequence[Markup]) -> str:
    """A report: its title, the result in a sentence, and sections."""
    header = element("header", element("h1", title), element("p", result, class_="result"))
    return page(title, ("page.css", "report.css"), joined([header, element("main", *sections)]))


def sentence(history: History) -> str:
    """The result in one sentence."""
    best, reference = history.best, history.reference
    if best is None:
        return _unfinished(history)
    value = f"{best.mean:.5g} ± {best.stderr:.2g} on {best.episodes:,} fresh worlds"
    start = f"With {history.episodes:,} episodes, {history.searcher} found a tree for {history.domain} worth {value}"
    if reference is None:
        return f"{start}."
    share = f"{history.ratio:.1%} of the {reference.mean:.5g}" if history.ratio else f"against the {reference.mean:.5g}"
    verdict = {True: "; every group that matters works", False: "; some group that matters does not work", None: ""}
    return f"{start}, {share} ± {reference.stderr:.2g} of the tree {reference.name!r}{verdict[history.complete]}."


def _unfinished(history: History) -> str:
    if not history.improvements:
        return f"The run has not found a tree yet, after {history.trials:,} trials."
    latest = history.improvements[-1]
    return (
        f"The run has not finished: after {history.episodes:,} episodes, {history.searcher} holds a tree for"
        f" {history.domain} whose mean return in the search is {latest.mean:.5g}, which flatters."
    )


def _best(history: History) -> Markup:
    figures = [] if history.tree is None else [trees.drawn("The best tree", history.tree)]
    if history.reference is not None:
        figures.append(trees.drawn(f"The reference: {history.reference.name}", history.reference.tree))
    legend = paragraph("Squares are actions, ovals conditions; ? is a fallback, → a sequence, ! a not.")
    return section("tree", "The tree", legend, element("div", *figures, class_="pair"))


def _learning(history: History, evidence: Evidence) -> Markup:
    if evidence.curve:
        text = f"Each best tree so far on {evidence.worlds:,} fresh worlds, with its 95 % interval."
        readings = [
            Reading(
                each.episodes, each.mean, each.mean - NORMAL_95 * each.stderr, each.mean + NORMAL_95 * each.stderr
            )
            for each in evidence.curve
        ]  # fmt: skip
    else:
        text = f"Means in the search, which flatter. The curve on fresh worlds is left out: {evidence.missing}."
        steps = thinned(history.improvements, _MOST_READINGS)
        readings = [Reading(max(each.episodes, 1), each.mean, each.mean, each.mean) for each in steps]
    lines = (Line(history.searcher, tuple(readings)),)
    chart = Chart("Learning curve", "episodes", "mean return", lines, _level(history, evidence)).figure()
    return section("curve", "Learning curve", paragraph(text), chart if readings else None)


def _level(history: History, evidence: Evidence) -> tuple[str, float] | None:
    """The reference, on the worlds of the curve if there is one."""
    if history.reference is None:
        return None
    value = history.reference.mean if evidence.reference is None else evidence.reference
    return history.reference.name, value


def _inspected(history: History, evidence: Evidence) -> list[Markup]:
    parts, nodes = "What each sub-tree contributes", "What each node does"
    seen = evidence.inspection
    if seen is None:
        text = paragraph(f"Left out: {evidence.missing}.")
        return [section("subtrees", parts, text), section("nodes", nodes, text)]
    counted = "in every tick" if seen.counted == "ticks" else "by how often leaves were ticked"
    return [
        section(
            "subtrees",
            parts,
            paragraph(f"Each is taken out in turn, and the tree run on the same {seen.episodes:,} fresh worlds."),
            trees.contributions(seen.ablation),
        ),
        section(
            "nodes",
            nodes,
            paragraph(
                f"In {seen.episodes:,} episodes, counted {counted}; {seen.coverage:.0f} % of the nodes are reached."
            ),
            trees.visits(parse(history.tree or ""), seen),
        ),
    ]


def _search(history: History) -> Markup:
    timing = read_timing(RunFolder(history.folder).timing)
    seconds = timing[-1].seconds if timing else 0.0
    rate = f", {history.episodes / seconds:,.0f} episodes a second" if seconds else ""
    stopped = f" It stopped because of: {history.stopped}." if history.stopped else ""
    text = f"{history.trials:,} trials and {history.episodes:,} episodes in {seconds:,.1f} s{rate}.{stopped}"
    return section("search", "The search", paragraph(text), _metrics(timing))


def _metrics(timing: Timing) -> Markup | None:
    told = [instant.metrics for instant in timing if instant.metrics]
    if not told:
        return None
    rows = []
    for name in told[-1]:
        values = [metrics[name] for metrics in told if name in metrics]
        course = element("span", sparkline(values, _WIDTH), class_="spark", aria_hidden="true")
        rows.append((name, f"{values[0]:.6g}", f"{values[-1]:.6g}", course))
    return table("What the searcher says of itself", ("Figure", "At first", "At last", "Over time"), rows)


def _failures(history: History) -> Markup:
    heading = "Evaluations that failed"
    failed = sum(number for status, number in history.statuses.items() if status != "ok")
    if not failed:
        return section("failures", heading, paragraph("None."))
    rows = [(f"{each.trial:,}", each.status, each.tree, each.error) for each in history.failures]
    text = f"{failed:,} of {history.trials:,} trials gave no return."
    caption = "All of them" if len(rows) == failed else f"The first {len(rows)}"
    listed = table(caption, ("Trial", "Status", "Tree", "Error"), rows)
    return section("failures", heading, paragraph(text), listed)
