"""The report about several runs: their curves together, and the statistics."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.report.charts import Chart, Line, Reading
from grammarbt.report.markup import Markup, details, element, paragraph, section, table
from grammarbt.report.plots import band
from grammarbt.report.single import report_page, sentence
from grammarbt.report.tables import HEAD, PAIR_HEAD, pair_cells, row_cells
from grammarbt.report.trees import drawn

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grammarbt.report.comparison import Comparison, Entrant
    from grammarbt.report.history import History

_MOST_TREES = 20
"""Best trees that are drawn."""


def several_report(
    histories: Sequence[History], entrants: Sequence[Entrant], comparison: Comparison, missing: str
) -> str:
    """The page.

    Args:
        histories: all runs, also those that go on.
        entrants: the finished ones, grouped.
        comparison: of the entrants.
        missing: why there are no curves; empty if there are.
    """
    finished = sum(history.finished for history in histories)
    result = f"{finished} of {len(histories)} runs have finished; {_leaders(comparison)}"
    sections = [_curves(entrants, missing), _statistics(comparison), _runs(histories), _trees(histories)]
    return report_page(f"{len(histories)} runs", result, sections)


def _leaders(comparison: Comparison) -> str:
    """Who has the highest value on each domain."""
    found = []
    for domain in dict.fromkeys(row.domain for row in comparison.rows):
        best = max((row for row in comparison.rows if row.domain == domain), key=lambda row: row.value.value)
        found.append(f"on {domain}, {best.searcher} has the highest interquartile mean, {best.value.value:.5g}")
    return "; ".join(found) + "." if found else "there is nothing to compare yet."


def _curves(entrants: Sequence[Entrant], missing: str) -> Markup:
    if missing:
        return section("curves", "Learning curves", paragraph(f"Left out: {missing}."))
    text = paragraph("The mean over seeds of the best trees so far on fresh worlds, with its bootstrap interval.")
    domains = dict.fromkeys(entrant.domain for entrant in entrants)
    charts = (_chart(domain, [each for each in entrants if each.domain == domain]) for domain in domains)
    return section("curves", "Learning curves", text, *charts)


def _chart(domain: str, entrants: Sequence[Entrant]) -> Markup:
    lines = [
        Line(entrant.searcher, tuple(map(Reading, *band(entrant.curves)))) for entrant in entrants if entrant.curves
    ]
    values = [run.reference.mean for each in entrants for run in each.runs.values() if run.reference]
    level = ("reference", sum(values) / len(values)) if values else None
    return Chart(f"Learning curves on {domain}", "episodes", "mean return", tuple(lines), level).figure()


def _statistics(comparison: Comparison) -> Markup:
    rows = table("By domain and searcher", HEAD, map(row_cells, comparison.rows))
    pairs = table("Pair by pair, over the seeds that both have", PAIR_HEAD, map(pair_cells, comparison.pairs))
    return section("statistics", "Statistics", rows, pairs if comparison.pairs else None)


def _runs(histories: Sequence[History]) -> Markup:
    rows = [(str(history.folder), history.title, sentence(history)) for history in histories]
    return section("runs", "The runs", table("Each run", ("Folder", "Run", "Result"), rows))


def _trees(histories: Sequence[History]) -> Markup:
    found = [history for history in histories if history.tree is not None]
    figures = [details(each.title, drawn(f"Best tree of {each.folder}", each.tree or "")) for each in found]
    more = f"The first {_MOST_TREES} of {len(found)}." if len(found) > _MOST_TREES else None
    text = paragraph(more) if more else None
    return section("trees", "The best trees", text, element("div", *figures[:_MOST_TREES]))
