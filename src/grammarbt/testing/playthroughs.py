"""Recorded episodes as text files beside the tests of a domain: a change of its rules shows as a difference of texts."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from attrs import frozen

from grammarbt.bt import parse
from grammarbt.domain.playthrough import WatchableDomain, playthrough


@frozen
class Playthroughs:
    """A folder of texts, each telling what a domain's first reference does in some scenarios.

    Attributes:
        folder: where the texts are.
        worlds: by file name, without `.txt`: what makes the domain, and the scenarios.
    """

    folder: Path
    worlds: Mapping[str, tuple[Callable[[], WatchableDomain], Sequence[int]]]

    def told(self, name: str) -> str:
        """What happens now."""
        make, scenarios = self.worlds[name]
        domain = make()
        tree = parse(domain.references[0].tree)
        return "\n".join(playthrough(domain, tree, scenario) for scenario in scenarios)

    def recorded(self, name: str) -> str:
        """What happened when it was recorded."""
        return self._path(name).read_text(encoding="utf-8")

    def record(self) -> None:
        """Write every text anew, after the rules were changed on purpose."""
        self.folder.mkdir(exist_ok=True)
        for name in self.worlds:
            self._path(name).write_text(self.told(name), encoding="utf-8")

    def _path(self, name: str) -> Path:
        return self.folder / f"{name}.txt"
