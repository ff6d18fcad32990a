"""A run of another process or machine, followed from its folder."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

from grammarbt.report.history import History, Reader
from grammarbt.report.timing import episodes_per_second
from grammarbt.run.folder import RunFolder
from grammarbt.run.journal import START, Position, events_after

_AT_ONCE = 10_000
"""Events that are in memory at a time."""


class Follower:
    """Reads what a run's journal says since the last look.

    Args:
        path: the run's folder.

    Raises:
        RunError: there is no run.
    """

    def __init__(self, path: Path) -> None:
        self._folder = RunFolder(path)
        self._resolved = cast("Mapping[str, Any]", self._folder.read_resolved())
        self._begin()

    def look(self) -> History:
        """The run as it is now.

        Raises:
            RunError: the journal is damaged.
        """
        journal = self._folder.journal
        if journal.exists():
            if journal.stat().st_size < self._position.size:  # the run was given a larger budget, and cut its end
                self._begin()
            while self._read(journal):
                pass
        return self._reader.history(self._folder.path, self._resolved)

    @property
    def rate(self) -> float | None:
        """Episodes per second of late; None while too little is known."""
        return episodes_per_second(self._folder.timing)

    def _begin(self) -> None:
        self._reader = Reader()
        self._position: Position = START

    def _read(self, journal: Path) -> bool:
        events, after = events_after(journal, self._position, _AT_ONCE)
        self._reader.read(cast("list[Mapping[str, Any]]", events))
        self._position = after
        return bool(events)
