"""Writing a run down: each batch to the journal, and now and then the time to a file of its own."""

from __future__ import annotations

import contextlib
import json
import time
from json.encoder import encode_basestring
from typing import TYPE_CHECKING

from grammarbt.errors import RunError
from grammarbt.run.journal import Journal, Position, encoded

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import Self, TextIO

    from grammarbt.run.evaluate import Trial
    from grammarbt.run.folder import RunFolder

_EVERY = 0.1
"""Seconds between two lines of timing, at least."""


class Recorder:
    """The journal and the timing of a run; use it in a `with`, which unlocks the journal at the end.

    Args:
        folder: where they are.
        journal: open.
        batches: how many are in the journal before the place where the run goes on.

    Attributes:
        batches: how many were recorded.
        metrics: what the searcher last said of itself, which goes to the timing.

    Raises:
        RunError: the timing cannot be written.
    """

    def __init__(self, folder: RunFolder, journal: Journal, batches: int = 0) -> None:
        self.batches = batches
        self.metrics: Mapping[str, float] = {}
        self._journal = journal
        try:
            self._timing = folder.timing.open("a+", encoding="utf-8", errors="replace")
            self._before = _last_seconds(self._timing)
        except OSError as error:
            journal.close()
            raise RunError(f"cannot write {str(folder.timing)!r}: {error.strerror}", "choose another folder") from None
        self._started = time.monotonic()
        self._due = self._before + _EVERY
        self._untimed = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._journal.close()
        with contextlib.suppress(RunError, OSError):  # a full disk has been reported already
            if self._untimed:
                self._time()
            self._timing.close()

    @property
    def seconds(self) -> float:
        """Time that the run has taken so far, all its sessions together; repeating a journal takes none."""
        return self._before + time.monotonic() - self._started

    @property
    def position(self) -> Position:
        """Where the journal goes on."""
        return self._journal.position

    def batch(self, trials: Sequence[Trial]) -> None:
        """What the searcher asked for, and what came of it."""
        self.batches += 1
        last = f',"batch":{self.batches}'
        self._journal.append([_trial_text("trial", trial, last) for trial in trials])
        if self._journal.repeating:
            self._started = time.monotonic()
            return
        self._untimed += sum([trial.simulated for trial in trials])
        if self.seconds >= self._due:
            self._time()

    def selection(self, trial: Trial) -> None:
        """A candidate's episodes in the final selection."""
        self._journal.append([_trial_text("selection", trial)])

    def event(self, **fields: object) -> None:
        """Anything else."""
        self._journal.append([encoded(fields)])

    def _time(self) -> None:
        seconds = self.seconds
        metrics = {name: float(value) for name, value in self.metrics.items()}
        line = {"batch": self.batches, "episodes": self._untimed, "seconds": round(seconds, 6), "metrics": metrics}
        self._due, self._untimed = seconds + _EVERY, 0
        try:
            self._timing.write(json.dumps(line) + "\n")
            self._timing.flush()
        except OSError as error:
            raise RunError(f"cannot write {self._timing.name!r}: {error.strerror}", "free some space") from None


def _trial_text(name: str, trial: Trial, last: str = "") -> str:
    """A trial as `encoded` writes events, at less cost; `simulated` of the returns cost budget, the others were known."""
    evaluation, proposal = trial.evaluation, trial.evaluation.proposal
    error = f',"error":{encoded(evaluation.error)}' if evaluation.error else ""
    return (
        f'{{"event":"{name}","tree":{encode_basestring(trial.text)},"start":{proposal.start:d},"stop":{proposal.stop:d},'
        f'"simulated":{trial.simulated},"status":"{evaluation.status}","returns":{_numbers(evaluation.returns)},'
        f'"ticks":{_numbers(evaluation.ticks)}{error}{last}}}'
    )


def _numbers(values: Sequence[float]) -> str:
    """Finite numbers and truth values, which Python writes like JSON but for spaces and capitals."""
    return str([*values]).replace(" ", "").lower()


def _last_seconds(timing: TextIO) -> float:
    """What the last line says that can be read; the clock is no part of what a run must repeat."""
    timing.seek(0)
    for line in reversed(timing.readlines()):
        with contextlib.suppress(ValueError, KeyError, TypeError):
            return max(0.0, float(json.loads(line)["seconds"]))
    return 0.0
