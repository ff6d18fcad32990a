"""`grammarbt watch`: follow a run from its folder."""

from __future__ import annotations

import time
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

import click
from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from grammarbt.bt import parse
from grammarbt.cli.drawing import drawing
from grammarbt.report.following import Follower
from grammarbt.report.single import sentence
from grammarbt.report.sparkline import course

if TYPE_CHECKING:
    from grammarbt.report.history import History

_EVERY, _EVERY_LINE = 0.5, 5.0
"""Seconds between two looks, and off a terminal between two lines."""

_WIDTH = 60
"""Letters of the curve."""


@click.command("watch")
@click.argument("run", type=click.Path(path_type=Path), metavar="RUN")
@click.option("--once", is_flag=True, help="Say where the run is now, and end.")
def command(run: Path, once: bool) -> None:
    """Follow RUN, which another process or machine may be making, until it finishes."""
    follower = Follower(run)
    history = follower.look()
    console = Console(stderr=True)
    if not once and not history.finished:
        history = _follow(follower, history, console)
    print(line(history, follower.rate) if not history.finished else sentence(history))


def _follow(follower: Follower, history: History, console: Console) -> History:
    terminal, due = console.is_terminal, 0.0
    with Live(console=console, transient=True, auto_refresh=False) if terminal else nullcontext() as live:
        while not history.finished:
            if live is not None:
                live.update(view(history, follower.rate), refresh=True)
            elif time.monotonic() >= due:
                due = time.monotonic() + _EVERY_LINE
                print(line(history, follower.rate), flush=True)
            time.sleep(_EVERY)
            history = follower.look()
    return history


def line(history: History, rate: float | None) -> str:
    """Where a run is, as a line."""
    parts = [f"{history.title}: {history.episodes:,} of {history.resolved['budget']:,} episodes"]
    parts += [] if rate is None or history.stopped else [f"{rate:,.0f}/s"]
    parts += [f"best {each.mean:.5g}  {each.tree}" for each in history.improvements[-1:]]
    return ", ".join(parts)


def view(history: History, rate: float | None) -> Group:
    """Where a run is, for a terminal: the curve of the best value, and the best tree, a node a line."""
    budget = int(history.resolved["budget"])
    phase = "choosing and validating" if history.stopped else "searching"
    speed = "" if rate is None else f", {rate:,.0f} episodes/s"
    rows = [history.title, f"{phase}: {history.episodes:,} of {budget:,} episodes{speed}"]
    if history.improvements:
        best = history.improvements[-1]
        curve = course([(each.episodes, each.mean) for each in history.improvements], history.episodes, _WIDTH)
        rows += [f"{curve}  best {best.mean:.5g} after {best.episodes:,} episodes", *drawing(parse(best.tree))]
    return Group(*(Text(row, overflow="ellipsis", no_wrap=True) for row in rows))
