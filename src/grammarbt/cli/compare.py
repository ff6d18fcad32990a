"""`grammarbt compare`: runs side by side."""

from __future__ import annotations

from pathlib import Path

import click

from grammarbt.cli.app import open_registry
from grammarbt.cli.options import json_option
from grammarbt.report import tables
from grammarbt.report.comparison import compare
from grammarbt.report.entrants import curve_measurer, entrants_of, titles_of
from grammarbt.report.history import read_histories


@click.command("compare")
@click.argument("runs", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="RUN...")
@click.option(
    "--target", type=float, default=0.95, metavar="SHARE", help="Of the reference's value; 0.95 unless given."
)
@click.option("--curve", type=int, default=0, metavar="EPISODES", help="Measure anytime curves on so many worlds.")
@json_option
def command(runs: tuple[Path, ...], target: float, curve: int, as_json: bool) -> None:
    """Compare finished runs, grouped by domain and searcher.

    Runs of the same seed met the same worlds, and are compared pair by pair.
    """
    titled = [(*titles_of(history), history) for history in read_histories(runs)]
    measure = curve_measurer(open_registry(), curve) if curve else None
    comparison = compare(entrants_of(titled, measure), target)
    print(tables.as_json(comparison) if as_json else tables.as_text(comparison), end="")
