"""Going on with a run that was stopped, or that is given a larger budget."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, cast

from attrs import evolve

from grammarbt.errors import GrammarBTError, RunError
from grammarbt.run.execute import Result, go_on
from grammarbt.run.journal import Journal
from grammarbt.run.replay import Replay, search_prefix
from grammarbt.run.setup import prepare
from grammarbt.run.spec import RunSpec

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from grammarbt.plugins import Registry
    from grammarbt.run.folder import Resolved, RunFolder
    from grammarbt.run.watch import Watcher

_FREE = ("versions", "spec", "budget")
"""What of `run.json` may differ when a run goes on."""


def resume(
    folder: RunFolder, budget: int | None, registry: Registry, watcher: Watcher, warn: Callable[[str], None]
) -> Result:
    """Replay a run and go on where its journal ends, to the journal that the uninterrupted run would have.

    With a larger budget only the search is replayed, and the final selection held again.

    Args:
        folder: the run's.
        budget: episodes in all; None for as many as before.
        registry: makes the domain and the searcher.
        watcher: told what happens.
        warn: told of versions that differ.

    Raises:
        RunError: the folder holds no run, is damaged, or what happened does not happen again.
        GrammarBTError: as `execute`.
    """
    before = folder.read_resolved()
    spec = _spec_of(before, folder)
    setup = prepare(evolve(spec, budget=spec.budget if budget is None else budget), registry)
    after = cast("Resolved", json.loads(json.dumps(setup.resolved)))
    _compare(before, after, folder)
    _warn_of_versions(before, after, warn)
    if setup.spec.budget < spec.budget:
        raise RunError(f"the run has a budget of {spec.budget:,} already", "give a larger one")
    keep = search_prefix(folder.journal) if setup.spec.budget > spec.budget else None
    journal = Journal.open(folder.journal, keep, lambda: folder.save_resolved(setup.resolved))
    return go_on(setup, folder, journal, Replay(folder.journal, keep), watcher)


def _spec_of(resolved: Resolved, folder: RunFolder) -> RunSpec:
    try:
        return RunSpec(**cast("dict[str, Any]", resolved["spec"]))
    except (KeyError, TypeError, GrammarBTError):
        raise RunError(f"{folder.resolved} is no run's of this version", "start the run anew") from None


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
