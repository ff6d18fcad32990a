"""What happened in a run, read from its folder."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, TypeAlias, cast

from attrs import define, field, frozen

from grammarbt.errors import RunError
from grammarbt.run.folder import RunFolder
from grammarbt.run.incumbent import Incumbent
from grammarbt.run.journal import iterate_journal

Recorded: TypeAlias = Mapping[str, Any]

_MOST_TREES = 200_000
"""Trees whose returns are added up; beyond, a tree is judged by its latest trial alone."""

_MOST_FAILURES = 50
"""Failures that are kept; the others are counted."""


@frozen
class Improvement:
    """A tree that became the incumbent.

    Attributes:
        episodes: simulated until then.
        trial: which trial it was, from 1.
        tree: in the one-line notation.
        mean: mean return in the search, which flatters.
    """

    episodes: int
    trial: int
    tree: str
    mean: float


@frozen
class Failure:
    """A trial that gave no return.

    Attributes:
        trial: which, from 1.
        tree: in the one-line notation.
        status: how it failed.
        error: why.
    """

    trial: int
    tree: str
    status: str
    error: str


@frozen
class Measured:
    """A tree's mean on validation scenarios."""

    name: str
    tree: str
    mean: float
    stderr: float
    episodes: int


@frozen
class History:
    """A run.

    Attributes:
        folder: where it is.
        resolved: what `run.json` says.
        improvements: every new incumbent, in order.
        statuses: trials by status.
        failures: the first that gave no return.
        trials: in all.
        episodes: simulated in all, the final selection included.
        stopped: why the search ended; None if it has not.
        validations: of the best tree and the reference, as far as made.
        complete: whether every group that matters works; None where that cannot be said.
        finished: whether the run went to its end.
    """

    folder: Path
    resolved: Recorded
    improvements: tuple[Improvement, ...]
    statuses: Mapping[str, int]
    failures: tuple[Failure, ...]
    trials: int
    episodes: int
    stopped: str | None
    validations: tuple[Measured, ...]
    complete: bool | None
    finished: bool

    @property
    def domain(self) -> str:
        """The domain's name."""
        return str(self.resolved["domain"]["name"])

    @property
    def searcher(self) -> str:
        """The searcher's name."""
        return str(self.resolved["searcher"]["name"])

    @property
    def seed(self) -> int:
        """The run's seed."""
        return int(self.resolved["seed"])

    @property
    def title(self) -> str:
        """What to call it."""
        return f"{self.searcher} on {self.domain}, seed {self.seed}"

    @property
    def tree(self) -> str | None:
        """The final tree, or while there is none the best so far; in the one-line notation."""
        if self.best is not None:
            return self.best.tree
        return self.improvements[-1].tree if self.improvements else None

    @property
    def best(self) -> Measured | None:
        """The final tree."""
        return next((each for each in self.validations if each.name == "best"), None)

    @property
    def reference(self) -> Measured | None:
        """The tree to compare with."""
        return next((each for each in self.validations if each.name != "best"), None)

    @property
    def ratio(self) -> float | None:
        """The best tree's value over the reference's, where that means something: both are positive."""
        if self.best is None or self.reference is None or self.reference.mean <= 0:
            return None
        return self.best.mean / self.reference.mean


def read_history(path: Path) -> History:
    """Read a run's folder; the run may be going on.

    Raises:
        RunError: there is no run, or it is damaged.
    """
    folder = RunFolder(path)
    resolved = cast("Recorded", folder.read_resolved())
    reader = Reader()
    if folder.journal.exists():
        reader.read(cast("Iterable[Recorded]", iterate_journal(folder.journal)))
    return reader.history(path, resolved)


def read_histories(paths: Iterable[Path]) -> list[History]:
    """Read several runs, in the order given.

    Raises:
        RunError: one of them cannot be read, or none is given.
    """
    found = [read_history(path) for path in paths]
    if not found:
        raise RunError("no run is given", "give the folders of runs")
    return found


@define
class Reader:
    """Reads a run event by event."""

    incumbent: Incumbent = field(factory=Incumbent)
    improvements: list[Improvement] = field(factory=list)
    statuses: Counter[str] = field(factory=Counter)
    failures: list[Failure] = field(factory=list)
    episodes: int = 0
    stopped: str | None = None
    validations: list[Measured] = field(factory=list)
    complete: bool | None = None
    finished: bool = False
    totals: dict[str, tuple[float, int]] = field(factory=dict)

    def read(self, events: Iterable[Recorded]) -> None:
        """Take in every event."""
        for event in events:
            kind = event["event"]
            if kind == "trial":
                self._trial(event)
            elif kind == "selection":
                self.episodes += event["simulated"]
            elif kind == "searched":
                self.stopped = event["stopped"]
            elif kind == "validation":
                self.validations.append(
                    Measured(event["name"], event["tree"], event["mean"], event["stderr"], event["episodes"])
                )
            elif kind == "finished":
                self.finished, self.complete = True, event["complete"]

    def _trial(self, event: Recorded) -> None:
        self.statuses[event["status"]] += 1
        self.episodes += event["simulated"]
        returns = event["returns"]
        if not returns:
            self._failure(event)
            return
        tree, fresh = event["tree"], returns[len(returns) - event["simulated"] :]
        total, episodes = self._added(tree, fresh, returns)
        if self.incumbent.consider(tree, total / episodes, episodes, fresh):
            number = self.statuses.total()
            self.improvements.append(Improvement(self.episodes, number, tree, total / episodes))

    def _failure(self, event: Recorded) -> None:
        if len(self.failures) < _MOST_FAILURES:
            number = self.statuses.total()
            self.failures.append(Failure(number, event["tree"], event["status"], event.get("error", "")))

    def _added(self, tree: str, fresh: list[float], returns: list[float]) -> tuple[float, int]:
        total, episodes = self.totals.get(tree, (0.0, 0))
        found = (total + sum(fresh), episodes + len(fresh)) if fresh or episodes else (sum(returns), len(returns))
        if tree in self.totals or len(self.totals) < _MOST_TREES:
            self.totals[tree] = found
        return found

    def history(self, path: Path, resolved: Recorded) -> History:
        """What was read."""
        return History(
            path,
            resolved,
            tuple(self.improvements),
            dict(self.statuses),
            tuple(self.failures),
            self.statuses.total(),
            self.episodes,
            self.stopped,
            tuple(self.validations),
            self.complete,
            self.finished,
        )
