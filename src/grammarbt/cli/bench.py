"""`grammarbt bench`: searchers × domains × seeds at equal budget."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from grammarbt.cli.app import open_registry
from grammarbt.cli.options import json_option
from grammarbt.report import tables
from grammarbt.report.comparison import Comparison, Entrant, compare
from grammarbt.report.entrants import curve_measurer, entrants_of
from grammarbt.report.history import read_history
from grammarbt.report.plots import save_curves
from grammarbt.run.bench import BenchSpec, Cell, cells, is_finished, read_bench, run_cells

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grammarbt.plugins import Registry


@click.command("bench")
@click.argument("spec", type=click.Path(path_type=Path), metavar="SPEC.toml")
@click.option("--workers", type=int, metavar="N", help="Runs side by side; as many as cores unless given.")
@json_option
def command(spec: Path, workers: int | None, as_json: bool) -> int:
    """Run a benchmark, or go on with it, and print its table.

    \b
    SPEC.toml:
        budget = 5000
        seeds = [100, 120]        # from, and up to but not including
        target = 0.95             # of the reference's value
        [[searcher]]
        name = "dagmcts"
        [[searcher]]
        name = "dagmcts"
        label = "paper"
        set = { preset = "paper" }
        [[domain]]
        name = "marine"

    Runs, tables (txt, csv, json) and curves (svg) are written to the folder named like SPEC beside it.
    """  # noqa: D301 - \b is click's mark for lines to leave alone
    asked = read_bench(spec)
    registry = open_registry()
    everything = cells(asked)
    failed = _run(everything, workers or asked.workers, registry)
    entrants = _entrants(asked, everything, registry)
    comparison = compare(entrants, asked.target)
    _write(Path(asked.out), comparison, entrants, curves=bool(asked.curve))
    print(tables.as_json(comparison) if as_json else tables.as_text(comparison), end="")
    return int(failed)


def _run(everything: Sequence[Cell], workers: int, registry: Registry) -> bool:
    """Whether a run failed."""
    todo = [cell for cell in everything if not is_finished(cell.folder)]
    done, failed = len(everything) - len(todo), False
    if done:
        print(f"{done} of {len(everything)} runs are there already", file=sys.stderr)
    for cell, problem in run_cells(todo, workers, registry.host.options):
        done, failed = done + 1, failed or bool(problem)
        name = f"{cell.domain}, {cell.searcher}, seed {cell.seed}"
        print(f"{done}/{len(everything)}  {name}{': ' + problem if problem else ''}", file=sys.stderr, flush=True)
    return failed


def _entrants(asked: BenchSpec, everything: Sequence[Cell], registry: Registry) -> list[Entrant]:
    titled = [
        (cell.domain, cell.searcher, read_history(cell.folder.path))
        for cell in everything
        if cell.folder.resolved.exists()
    ]
    return entrants_of(titled, curve_measurer(registry, asked.curve) if asked.curve else None)


def _write(folder: Path, comparison: Comparison, entrants: Sequence[Entrant], *, curves: bool) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (("table.txt", tables.as_text), ("table.csv", tables.as_csv), ("table.json", tables.as_json)):
        (folder / name).write_text(text(comparison), encoding="utf-8")
    if curves:
        save_curves(entrants, folder / "curves.svg")
