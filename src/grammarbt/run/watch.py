"""Whoever watches a run: told what happens, never asked."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from pathlib import Path

    from grammarbt.plugins.events import RunFinished, RunStarted, TrialFinished

    RunEvent: TypeAlias = RunStarted | TrialFinished | RunFinished


class Watcher:
    """Watches without a word; override what is of interest."""

    def folder(self, path: Path) -> None:
        """The run's folder stands."""

    def phase(self, name: str, episodes: int) -> None:
        """A phase of about so many episodes begins: searching, selecting, validating."""

    def advance(self, episodes: int) -> None:
        """Episodes of the phase were simulated."""

    def notify(self, event: RunEvent) -> None:
        """What observers among the plugins are told too."""
