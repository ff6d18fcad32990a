"""Resume is replay: the searcher is asked again, and what it asked for is answered from the journal."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, Any, cast

from grammarbt.bt import format_tree
from grammarbt.errors import RunError
from grammarbt.run.journal import iterate_journal
from grammarbt.run.simulate import Simulation

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from grammarbt.search import Proposal

_TRIALS = ("trial", "selection")


class Replay:
    """The trials of a journal, each taken once, in order.

    Args:
        path: the journal; None for a run that begins.
        keep: how many of its events count; None for all.
    """

    def __init__(self, path: Path | None = None, keep: int | None = None) -> None:
        self._path = path
        self._events = iter(()) if path is None else _numbered(path, keep)
        self._next = next(self._events, None)

    @property
    def going(self) -> bool:
        """Whether events are left."""
        return self._next is not None

    @property
    def out_of_time(self) -> bool:
        """Whether the clock ended the search here."""
        return self._next is not None and self._next[1].get("stopped") == "seconds"

    def take(self, proposal: Proposal, missing: Sequence[int]) -> Simulation | None:
        """What simulating the missing scenarios of a proposal gave; None when the journal has ended.

        Raises:
            RunError: the journal has another proposal here.
        """
        while self._next is not None and self._next[1]["event"] not in _TRIALS:
            self._next = next(self._events, None)
        if self._next is None:
            return None
        line, event = self._next
        self._check(proposal, line, event)
        self._next = next(self._events, None)
        if event["status"] != "ok":
            return Simulation((), (), event["status"], event["error"])
        return Simulation(tuple(event["returns"][number - proposal.start] for number in missing), tuple(event["ticks"]))

    def _check(self, proposal: Proposal, line: int, event: dict[str, Any]) -> None:
        asked = (format_tree(proposal.tree), proposal.start, proposal.stop)
        found = (event["tree"], event["start"], event["stop"])
        if asked != found:
            raise RunError(
                f"{self._path}, line {line}: trial {line} was {_text(*found)}, but now the searcher proposes {_text(*asked)}",
                "resume with the versions and parameters that the run began with",
            )


def search_prefix(path: Path) -> int:
    """How many events of a journal a run with a larger budget repeats: the search's, without its last batch.

    The last batch may have been cut short by the budget.
    """
    batches = [(number, event["batch"]) for number, event in _numbered(path, None) if event["event"] == "trial"]
    return sum(batch != batches[-1][1] for _, batch in batches)


def _numbered(path: Path, keep: int | None) -> Iterator[tuple[int, dict[str, Any]]]:
    return enumerate(islice(cast("Iterator[dict[str, Any]]", iterate_journal(path)), keep), 1)


def _text(tree: str, start: int, stop: int) -> str:
    return f"{tree} on the scenarios {start} to {stop}"
