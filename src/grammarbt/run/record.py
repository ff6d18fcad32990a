"""Writing a run down: each batch to the journal, its time to a file of its own."""

from __future__ import annotations

import json
import time
from typing import TYPE_CHECKING

from grammarbt.bt import format_tree
from grammarbt.errors import RunError
from grammarbt.run.journal import Journal

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Self

    from grammarbt.run.evaluate import Trial
    from grammarbt.run.folder import RunFolder


class Recorder:
    """The journal and the timing of a run; use it in a `with`, which unlocks the journal at the end.

    Args:
        folder: where they are.
        journal: open.

    Raises:
        RunError: the timing cannot be written.
    """

    def __init__(self, folder: RunFolder, journal: Journal) -> None:
        self._journal = journal
        try:
            self._timing = folder.timing.open("a", encoding="utf-8")
        except OSError as error:
            journal.close()
            raise RunError(f"cannot write {str(folder.timing)!r}: {error.strerror}", "choose another folder") from None
        self._started = time.monotonic()
        self._batches = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._journal.close()
        self._timing.close()

    @property
    def seconds(self) -> float:
        """Time since the beginning."""
        return time.monotonic() - self._started

    def batch(self, trials: Sequence[Trial]) -> None:
        """What the searcher asked for, and what came of it."""
        self._batches += 1
        self._journal.append(trial_event("trial", trial) | {"batch": self._batches} for trial in trials)
        if not self._journal.repeating:
            self._time(sum(trial.simulated for trial in trials))

    def selection(self, trial: Trial) -> None:
        """A candidate's episodes in the final selection."""
        self._journal.append([trial_event("selection", trial)])

    def event(self, **fields: object) -> None:
        """Anything else."""
        self._journal.append([fields])

    def _time(self, episodes: int) -> None:
        line = {"batch": self._batches, "episodes": episodes, "seconds": round(self.seconds, 6)}
        try:
            self._timing.write(json.dumps(line) + "\n")
            self._timing.flush()
        except OSError as error:
            raise RunError(f"cannot write {self._timing.name!r}: {error.strerror}", "free some space") from None


def trial_event(name: str, trial: Trial) -> dict[str, object]:
    """A trial as the journal's JSON; `simulated` of the returns cost budget, the others were known."""
    evaluation = trial.evaluation
    event: dict[str, object] = {
        "event": name,
        "tree": format_tree(evaluation.proposal.tree),
        "start": evaluation.proposal.start,
        "stop": evaluation.proposal.stop,
        "simulated": trial.simulated,
        "status": evaluation.status,
        "returns": evaluation.returns,
        "ticks": evaluation.ticks,
    }
    return event | ({"error": evaluation.error} if evaluation.error else {})
