"""What a run shows while it goes on: a live display on a terminal, a line now and then elsewhere."""

from __future__ import annotations

import sys
import time
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console, Group
from rich.live import Live
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn
from rich.text import Text

from grammarbt.plugins.events import TrialFinished
from grammarbt.report.sparkline import course
from grammarbt.run.watch import Watcher

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.plugins import PluginHost
    from grammarbt.run.watch import RunEvent

_EVERY = 5.0
"""Seconds between two plain lines."""

_SETTLED = 10
"""Episodes before the rate says something about the rest: the first wait for a domain to compile."""


_CURVE = 60
"""Letters of the curve."""


class Display(Watcher):
    """Passes events on to the plugins, and keeps the figures that every display shows."""

    def __init__(self, host: PluginHost) -> None:
        self._host = host
        self.name, self.total, self.done = "", 0, 0
        self.latest: TrialFinished | None = None
        self.steps: list[tuple[int, float]] = []
        self.path = Path()
        self.started = time.monotonic()

    def shown(self) -> AbstractContextManager[object]:
        """In force while the run goes on."""
        return nullcontext()

    def folder(self, path: Path) -> None:
        """Remember where the run is."""
        self.path = path

    def notify(self, event: RunEvent) -> None:
        """Remember the best tree; tell the plugins."""
        if isinstance(event, TrialFinished) and event.best_tree:
            self.latest = event
            if not self.steps or self.steps[-1][1] != event.best:
                self.steps.append((event.episodes, event.best))
        self._host.notify(event)

    def phase(self, name: str, episodes: int) -> None:
        """Begin to count anew."""
        self.name, self.total, self.done = name, episodes, 0
        self.started = time.monotonic()

    def advance(self, episodes: int) -> None:
        """Count."""
        self.done += episodes

    @property
    def best(self) -> str:
        """The best tree so far, if there is one."""
        return f"best {self.latest.best:.5g}  {self.latest.best_tree}" if self.latest else ""

    @property
    def rate(self) -> float:
        """Episodes per second in this phase."""
        return self.done / max(time.monotonic() - self.started, 1e-6)


class Lines(Display):
    """One plain line on standard error every few seconds."""

    def __init__(self, host: PluginHost, say: Callable[[str], None]) -> None:
        super().__init__(host)
        self._say = say
        self._next = time.monotonic() + _EVERY

    def advance(self, episodes: int) -> None:
        """Count, and say so when it is time."""
        super().advance(episodes)
        if time.monotonic() >= self._next:
            self._next = time.monotonic() + _EVERY
            self._say(self._line())

    def _line(self) -> str:
        of = f" of {self.total:,}" if self.total else ""
        known = self.total and self.done >= _SETTLED and self.rate
        eta = f", {max(self.total - self.done, 0) / self.rate:.0f} s left" if known else ""
        return f"{self.name}: {self.done:,}{of} episodes, {self.rate:,.0f}/s{eta}; {self.best}".rstrip("; ")


class LiveDisplay(Display):
    """A bar with the time left and episodes per second, under it the best value's curve and the best tree."""

    def __init__(self, host: PluginHost) -> None:
        super().__init__(host)
        self._bar = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            TaskProgressColumn(),
            TextColumn("{task.fields[rate]} episodes/s, left"),
            TimeRemainingColumn(),
        )
        self._task = self._bar.add_task("", rate="")

    def shown(self) -> AbstractContextManager[object]:
        """The live display."""
        return Live(get_renderable=self._render, console=Console(stderr=True), transient=True, refresh_per_second=4)

    def phase(self, name: str, episodes: int) -> None:
        """Begin a new bar."""
        super().phase(name, episodes)
        self._bar.remove_task(self._task)
        self._task = self._bar.add_task(name, total=episodes or None, rate="")

    def _render(self) -> Group:
        self._bar.update(self._task, completed=self.done, rate=f"{self.rate:,.0f}")
        curve = Text(course(self.steps, self.latest.episodes if self.latest else 0, _CURVE))
        return Group(self._bar, curve, Text(self.best, overflow="ellipsis"))


def make_display(host: PluginHost, *, quiet: bool) -> Display:
    """The display that suits where standard error goes."""
    if quiet:
        return Display(host)
    if sys.stderr.isatty():
        return LiveDisplay(host)
    return Lines(host, lambda line: print(line, file=sys.stderr, flush=True))
