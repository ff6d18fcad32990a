"""Going on with a run that was stopped, or that is given a larger budget."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Mapping
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from attrs import Factory, evolve, frozen

from grammarbt.errors import GrammarBTError, RunError
from grammarbt.grammar import Source
from grammarbt.run.execute import Past, Result, go_on
from grammarbt.run.folder import RunFolder
from grammarbt.run.journal import START, Journal
from grammarbt.run.replay import Replay, search_prefix
from grammarbt.run.setup import prepare
from grammarbt.run.snapshot import read_snapshot
from grammarbt.run.spec import Part, RunSpec

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.plugins import Registry
    from grammarbt.run.folder import Resolved
    from grammarbt.run.setup import Setup
    from grammarbt.run.watch import Watcher

_FREE = ("versions", "spec", "budget", "directory")
"""What of `run.json` may differ when a run goes on."""


def resume(
    folder: RunFolder, changes: Changes, registry: Registry, watcher: Watcher, warn: Callable[[str], None]
) -> Result:
    """Replay a run and go on where its journal ends, to the journal that the uninterrupted run would have.

    With a larger budget only the search is replayed, and the final selection held again. Relative paths mean what they
    meant where the run began.

    Args:
        folder: the run's.
        changes: what is to be otherwise than before.
        registry: makes the domain and the searcher.
        watcher: told what happens.
        warn: told of versions that differ, and of a snapshot that cannot be used.

    Raises:
        RunError: the folder holds no run, is damaged, or what happened does not happen again.
        GrammarBTError: as `execute`.
    """
    folder = RunFolder(folder.path.absolute())
    before = folder.read_resolved()
    with _directory(before):
        spec = _spec_of(before, folder)
        setup = prepare(changes.apply(spec), registry, _grammar_of(before))
        if setup.spec.budget < spec.budget:
            raise RunError(f"the run has a budget of {spec.budget:,} already", "give a larger one")
        after = cast("Resolved", json.loads(json.dumps(setup.resolved)))
        _compare(before, after, folder)
        _warn_of_versions(before, after, warn)
        past = _longer(folder, setup) if setup.spec.budget > spec.budget else _same(folder, setup, warn)
        return go_on(setup, folder, past, watcher)


@frozen
class Changes:
    """What a run that goes on may have otherwise; None as before.

    The journal depends on none of these but the budget.

    Attributes:
        budget: episodes in all, no fewer than before.
        workers: simulations side by side.
        executor: an executor's name; its parameters are those of `settings` alone.
        settings: parameters of the executor.
    """

    budget: int | None = None
    workers: int | None = None
    executor: str | None = None
    settings: Mapping[Part, Mapping[str, object]] = Factory(dict)

    def apply(self, spec: RunSpec) -> RunSpec:
        """The spec with these changes."""
        options = {"budget": self.budget, "workers": self.workers, "executor": self.executor}
        changed = spec.overridden(options, {})
        if changed.executor_name != spec.executor_name:
            changed = evolve(changed, set={part: given for part, given in changed.set.items() if part != "executor"})
        return changed.overridden({}, self.settings)


def _same(folder: RunFolder, setup: Setup, warn: Callable[[str], None]) -> Past:
    """Everything that the journal says happens again."""
    snapshot = read_snapshot(folder, setup, warn)
    start = snapshot.position if snapshot else START
    journal = Journal.open(folder.journal, extended=lambda: folder.save_resolved(setup.resolved), start=start)
    return Past(journal, Replay(folder.journal, start=start), snapshot)


def _longer(folder: RunFolder, setup: Setup) -> Past:
    """With a larger budget, the search happens again.

    A searcher may plan with its budget, so a snapshot tells nothing about where it would stand with another.
    """
    keep = search_prefix(folder.journal)
    journal = Journal.open(folder.journal, keep, lambda: folder.save_resolved(setup.resolved))
    return Past(journal, Replay(folder.journal, keep))


def _directory(resolved: Resolved) -> AbstractContextManager[None]:
    """The one in which the run began, if it is still there."""
    directory = Path(str(resolved.get("directory", "")))
    return contextlib.chdir(directory) if directory.is_dir() else contextlib.nullcontext()


def _spec_of(resolved: Resolved, folder: RunFolder) -> RunSpec:
    try:
        return RunSpec(**cast("dict[str, Any]", resolved["spec"]))
    except (KeyError, TypeError, GrammarBTError):
        raise RunError(f"{folder.resolved} is no run's of this version", "start the run anew") from None


def _grammar_of(resolved: Resolved) -> Source:
    kept = cast("dict[str, Any]", resolved["grammar"])
    return Source(kept["name"], kept["text"], neighbours=kept.get("neighbours") or {})


def _compare(before: Resolved, after: Resolved, folder: RunFolder) -> None:
    changed = [key for key in after if key not in _FREE and before.get(key) != after[key]]
    if changed:
        raise RunError(
            f"the {' and the '.join(changed)} of {str(folder.path)!r} have changed since it began",
            f"{folder.resolved.name} there says what they were",
        )


def _warn_of_versions(before: Resolved, after: Resolved, warn: Callable[[str], None]) -> None:
    was, now = (cast("Mapping[str, str]", resolved["versions"]) for resolved in (before, after))
    names = [name for name in {**was, **now} if was.get(name) != now.get(name)]
    if names:
        changes = ", ".join(f"{name} {was.get(name, 'absent')} then, {now.get(name, 'absent')} now" for name in names)
        warn(f"versions differ from those the run began with: {changes}")
