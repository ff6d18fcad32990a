"""`grammarbt run`: learn a tree."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from math import hypot
from pathlib import Path

import attrs
import click

from grammarbt.cli.app import open_registry
from grammarbt.cli.options import json_option, quiet_option
from grammarbt.cli.output import emit_json, table, warn
from grammarbt.cli.progress import Display, make_display
from grammarbt.run.execute import Result, execute
from grammarbt.run.setup import prepare
from grammarbt.run.spec import RunSpec, read_spec, settings_of


@click.command("run")
@click.argument("spec", required=False, metavar="[SPEC.toml]")
@click.option("--grammar", metavar="NAME|FILE", help="The language to search; the domain's own unless given.")
@click.option("--domain", metavar="NAME|FILE.py:NAME", help="The simulator; marine unless given.")
@click.option("--searcher", metavar="NAME", help="The search method; dagmcts unless given.")
@click.option("--set", "settings", multiple=True, metavar="PART.KEY=VALUE", help="A parameter of a part; repeatable.")
@click.option("--budget", type=int, metavar="EPISODES", help="Episodes to simulate; 5000 unless given.")
@click.option("--seed", type=int, metavar="N", help="Fixes everything random; 0 unless given.")
@click.option("--batch", type=int, metavar="N", help="Trees asked for at a time; 1 unless given.")
@click.option("--workers", type=int, metavar="N", help="Simulations side by side; 1 unless given.")
@click.option("--executor", metavar="NAME", help="What simulates: serial, or processes if there are workers.")
@click.option("--out", metavar="DIR", help="The run folder, new or empty; a fresh one under runs/ unless given.")
@click.option("--start", metavar="TREE", help="A tree to begin from: notation, a file or a run folder.")
@click.option("--trials", type=int, metavar="N", help="Stop the search after so many trials.")
@click.option("--seconds", type=float, metavar="N", help="Stop the search after so much time.")
@click.option("--target", type=float, metavar="VALUE", help="Stop the search when the best mean return reaches it.")
@click.option("--stagnation", type=int, metavar="EPISODES", help="Stop the search when so many found no better tree.")
@click.option(
    "--validation", type=int, metavar="EPISODES", help="Fresh worlds to score the tree on; 2000 unless given."
)
@json_option
@quiet_option
def command(spec: str | None, settings: tuple[str, ...], as_json: bool, quiet: bool, **options: object) -> None:
    """Learn a behavior tree.

    \b
    SPEC.toml holds the same options; those on the command line win:
        domain = "marine"
        budget = 5000
        [set.searcher]
        preset = "paper"
    """  # noqa: D301 - \b is click's mark for lines to leave alone
    asked = (RunSpec() if spec is None else read_spec(Path(spec))).overridden(options, settings_of(settings))
    registry = open_registry()
    display = make_display(registry.host, quiet=quiet)
    setup = prepare(asked, registry)
    if asked.workers > asked.batch:
        warn(f"with --batch {asked.batch}, {asked.workers} workers search no faster than {asked.batch}")
    with interruptible(display):
        result = execute(setup, display)
    emit(result, as_json=as_json)


@contextmanager
def interruptible(display: Display) -> Iterator[None]:
    """Show the display; after Ctrl-C, say where to find what was found."""
    try:
        with display.shown():
            yield
    except KeyboardInterrupt:
        print(f"interrupted; go on with: grammarbt resume {display.path}", file=sys.stderr)
        raise


def emit(result: Result, *, as_json: bool) -> None:
    """Print what a run found."""
    if as_json:
        emit_json(attrs.asdict(result))
    else:
        print(_summary(result))


def _summary(result: Result) -> str:
    rows = [
        ("tree", result.tree),
        ("value", f"{result.value:.5g} ± {result.stderr:.2g} on {result.validation:,} fresh worlds"),
    ]
    if result.reference:
        other = result.reference
        rows.append(("reference", f"{other.value:.5g} ± {other.stderr:.2g} ({other.name}, same worlds)"))
        gain, error = result.value - other.value, hypot(result.stderr, other.stderr)
        rows.append(("gain", f"{gain:+.4g} ± {error:.2g}"))
    if result.ratio is not None and result.reference and result.reference.value > 0.0:  # else more is not better
        rows.append(("ratio", f"{result.ratio:.3f}"))
    if result.complete is not None:
        rows.append(("complete", "every group that matters works" if result.complete else "some group does not work"))
    rows += [
        ("search", f"{result.episodes:,} episodes, {result.trials:,} trials, {result.seconds:.1f} s{_failed(result)}"),
        ("run", result.run),
    ]
    return table(rows)


def _failed(result: Result) -> str:
    """How many trials of the search gave no return, and why."""
    return "".join(f", {number:,} {status}" for status, number in result.failed.items())
