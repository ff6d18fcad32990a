"""`grammarbt report`: what runs amounted to, as a page or a picture."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from grammarbt.cli.app import open_registry
from grammarbt.errors import FormatError, GrammarBTError, RunError
from grammarbt.report.comparison import Entrant, compare
from grammarbt.report.entrants import curve_measurer, entrants_of, titles_of
from grammarbt.report.evidence import LEFT_OUT, gather
from grammarbt.report.history import read_histories
from grammarbt.report.plots import save_curves
from grammarbt.report.several import several_report
from grammarbt.report.single import single_report

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grammarbt.report.history import History

_PAGE = "report.html"
_PICTURES = (".svg", ".pdf", ".png")


@click.command("report")
@click.argument("runs", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="RUN...")
@click.option(
    "-o", "--output", type=click.Path(path_type=Path),
    help="The file; report.html in the run's folder, or here for several runs, unless given.",
)  # fmt: skip
@click.option(
    "--episodes", type=click.IntRange(min=0), default=200, metavar="N",
    help="Fresh worlds per tree to simulate; 200 unless given, 0 to simulate nothing.",
)  # fmt: skip
@click.option("--target", type=float, default=0.95, metavar="SHARE", help="Of the reference; 0.95 unless given.")
def command(runs: tuple[Path, ...], output: Path | None, episodes: int, target: float) -> None:
    """Write a page about RUN, or one that compares several.

    The page is one file that needs nothing else. An output that ends in .svg, .pdf or .png holds the learning curves.
    """
    histories = read_histories(runs)
    path = output or (runs[0] / _PAGE if len(runs) == 1 else Path(_PAGE))
    if path.suffix in _PICTURES:
        save_curves(_measured(histories, episodes), path)
    elif path.suffix in (".html", ".htm"):
        path.write_text(_page(histories, episodes, target), encoding="utf-8")
    else:
        raise FormatError(f"{str(path)!r} is neither a page nor a picture", "end it in .html, .svg, .pdf or .png")
    print(path)


def _page(histories: Sequence[History], episodes: int, target: float) -> str:
    if len(histories) == 1:
        return single_report(histories[0], gather(histories[0], open_registry, episodes))
    entrants, missing = _plain(histories), LEFT_OUT
    if episodes:
        try:
            entrants, missing = _measured(histories, episodes), ""
        except GrammarBTError as error:
            missing = str(error)
    return several_report(histories, entrants, compare(entrants, target), missing)


def _plain(histories: Sequence[History]) -> list[Entrant]:
    return entrants_of([(*titles_of(history), history) for history in histories], None)


def _measured(histories: Sequence[History], episodes: int) -> list[Entrant]:
    """With curves on fresh worlds."""
    if not episodes:
        raise RunError("curves take simulating", "give --episodes a number above 0")
    if not any(history.finished for history in histories):
        raise RunError("none of the runs has finished", "try again later, or resume them")
    titled = [(*titles_of(history), history) for history in histories]
    return entrants_of(titled, curve_measurer(open_registry(), episodes))
