"""Snapshots: where a search stood, so that a resumed run need not replay all that came before.

A run has them if its searcher is `Snapshotting`. They are a convenience: without one, or with one that is damaged, the
whole journal is replayed, to the same bytes.
"""

from __future__ import annotations

import contextlib
import time
from typing import TYPE_CHECKING, Any, cast

import cattrs
from attrs import frozen

from grammarbt.errors import RunError
from grammarbt.run.folder import RunFolder, read_sealed, save_sealed
from grammarbt.run.journal import Position, holds
from grammarbt.run.packing import packed, unpack
from grammarbt.run.stopping import Tally
from grammarbt.search import Snapshotting

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from grammarbt.run.evaluate import Evaluator
    from grammarbt.run.record import Recorder
    from grammarbt.run.setup import Setup

SHARE = 0.02
"""Share of a run's time that snapshots may take."""


@frozen
class Snapshot:
    """Where a search stands between two batches.

    Attributes:
        versions: with which versions it was made.
        position: the journal's end then.
        batches: recorded so far.
        tally: the counts and the best tree.
        cache: the returns known, as `packed` writes them.
        rng: the state of the searcher's random generator.
        searcher: what the searcher said.
    """

    versions: dict[str, str]
    position: Position
    batches: int
    tally: Tally
    cache: dict[str, str]
    rng: dict[str, Any]
    searcher: dict[str, Any]


class Camera:
    """Makes a snapshot now and then.

    Args:
        folder: where it is kept.
        setup: the run's parts.
        evaluator: knows returns.
        recorder: knows how far the journal is.
        tally: the search's counts.
    """

    def __init__(self, folder: RunFolder, setup: Setup, evaluator: Evaluator, recorder: Recorder, tally: Tally) -> None:
        self._folder = folder
        self._setup = setup
        self._evaluator = evaluator
        self._recorder = recorder
        self._tally = tally
        self._searcher = setup.searcher if isinstance(setup.searcher, Snapshotting) else None
        self._due = time.monotonic() + setup.spec.snapshot

    def shoot(self) -> None:
        """Make a snapshot if it is time; to be called between two batches."""
        now = time.monotonic()
        if self._searcher is None or now < self._due or self._evaluator.replay.going:
            return
        with contextlib.suppress(RunError):  # no room for it: the journal says all that is needed
            save_sealed(self._folder.snapshot, cattrs.unstructure(self._snapshot(self._searcher)))
        end = time.monotonic()
        self._due = end + max(self._setup.spec.snapshot, (end - now) / SHARE)

    def _snapshot(self, searcher: Snapshotting) -> Snapshot:
        rng = cast("dict[str, Any]", self._setup.rng.bit_generator.state)
        versions = cast("dict[str, str]", self._setup.resolved["versions"])
        position, batches = self._recorder.position, self._recorder.batches
        cache = packed(self._evaluator.cache)
        return Snapshot(versions, position, batches, self._tally, cache, rng, dict(searcher.snapshot()))


def restore(snapshot: Snapshot, setup: Setup, evaluator: Evaluator) -> Tally:
    """Bring fresh parts to where a snapshot was made; gives the counts."""
    cast("Snapshotting", setup.searcher).restore(snapshot.searcher)
    setup.rng.bit_generator.state = snapshot.rng
    unpack(snapshot.cache, evaluator.cache)
    evaluator.episodes = snapshot.tally.episodes
    return snapshot.tally


def read_snapshot(folder: RunFolder, setup: Setup, warn: Callable[[str], None]) -> Snapshot | None:
    """A run's snapshot, if there is one that can be used; a word of warning if it cannot."""
    if not isinstance(setup.searcher, Snapshotting) or not folder.snapshot.exists():
        return None
    try:
        snapshot = cattrs.structure(read_sealed(folder.snapshot), Snapshot)
    except (OSError, RunError, cattrs.BaseValidationError):
        fault = "it is damaged"
    else:
        fault = _fault(snapshot, folder, setup)
        if not fault:
            return snapshot
    warn(f"{folder.snapshot} is ignored, {fault}; the whole journal is replayed")
    return None


def _fault(snapshot: Snapshot, folder: RunFolder, setup: Setup) -> str:
    """Why a snapshot cannot be used; empty if it can."""
    if snapshot.versions != cast("Mapping[str, str]", setup.resolved["versions"]):
        return "it was made with other versions"
    return "" if holds(folder.journal, snapshot.position) else "it does not belong to the journal"
