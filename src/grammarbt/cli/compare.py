"""`grammarbt compare`: runs side by side."""

from __future__ import annotations

from pathlib import Path

import click

from grammarbt.cli.app import open_registry
from grammarbt.report.comparison import compare
from grammarbt.report.entrants import curve_measurer, entrants_of, titles_of
from grammarbt.report.history import read_histories
from grammarbt.report.tables import as_json, as_text


@click.command("compare")
@click.argument("runs", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="RUN...")
@click.option(
    "--target", type=float, default=0.95, metavar="SHARE", help="Of the reference's value; 0.95 unless given."
)
@click.option("--curve", type=int, default=0, metavar="EPISODES", help="Measure anytime curves on so many worlds.")
@click.option("--json", "as_json_", is_flag=True, help="Print one JSON object.")
def command(runs: tuple[Path, ...], target: float, curve: int, as_json_: bool) -> None:
    """Compare finished runs, grouped by domain and searcher.

    Runs of the same seed met the same worlds, and are compared pair by pair.
    """
    titled = [(*titles_of(history), history) for history in read_histories(runs)]
    measure = curve_measurer(open_registry(), curve) if curve else None
    comparison = compare(entrants_of(titled, measure), target)
    print(as_json(comparison) if as_json_ else as_text(comparison), end="")
