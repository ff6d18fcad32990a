"""Resume is replay: the searcher is asked again, and what it asked for is answered from the journal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias, cast

from grammarbt.errors import RunError
from grammarbt.run.journal import START, Position, iterate_journal
from grammarbt.run.simulate import Simulation

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from grammarbt.search import Proposal

Recorded: TypeAlias = dict[str, Any]

_TRIALS = ("trial", "selection")


class Replay:
    """The trials of a journal, each taken once, in order.

    Args:
        path: the journal; None for a run that begins.
        keep: how many of its events count; None for all.
        start: where to begin.
    """

    def __init__(self, path: Path | None = None, keep: int | None = None, start: Position = START) -> None:
        self._path = path
        self._line = start.events
        self._events = iter(()) if path is None else _events(path, keep, start)
        self._next = next(self._events, None)

    @property
    def going(self) -> bool:
        """Whether events are left."""
        return self._next is not None

    @property
    def out_of_time(self) -> bool:
        """Whether the clock ended the search here."""
        return self._next is not None and self._next.get("stopped") == "seconds"

    def take(self, proposal: Proposal, text: str, missing: Sequence[int]) -> Simulation | None:
        """What simulating the missing scenarios of a proposal gave; None when the journal has ended.

        Args:
            proposal: what the searcher asks for.
            text: its tree in the one-line notation.
            missing: the scenarios whose returns are not known.

        Raises:
            RunError: the journal has another proposal here.
        """
        while self._next is not None and self._next["event"] not in _TRIALS:
            self._advance()
        event = self._next
        if event is None:
            return None
        self._check(event, (text, proposal.start, proposal.stop))
        self._advance()
        if event["status"] != "ok":
            return Simulation((), (), event["status"], event["error"])
        return Simulation(tuple([event["returns"][at - proposal.start] for at in missing]), tuple(event["ticks"]))

    def _advance(self) -> None:
        self._line += 1
        self._next = next(self._events, None)

    def _check(self, event: Recorded, asked: tuple[str, int, int]) -> None:
        found = (event["tree"], event["start"], event["stop"])
        if asked != found:
            # Nothing but trials stands in a journal before the selection, so a trial's number is its line.
            line = self._line + 1
            what = f"trial {line}" if event["event"] == "trial" else "a trial of the selection"
            raise RunError(
                f"{self._path}, line {line}: {what} was {_text(*found)}, but now the searcher proposes {_text(*asked)}",
                "resume with the versions and parameters that the run began with",
            )


def search_prefix(path: Path) -> int:
    """How many events of a journal a run with a larger budget repeats: the search's, without its last batch.

    The last batch may have been cut short by the budget.
    """
    last = before = 0  # the last batch, and the events before it
    for number, event in enumerate(_events(path, None, START)):
        if event["event"] == "trial" and event["batch"] != last:
            last, before = event["batch"], number
    return before


def _events(path: Path, keep: int | None, start: Position) -> Iterator[Recorded]:
    return cast("Iterator[Recorded]", iterate_journal(path, keep, start))


def _text(tree: str, start: int, stop: int) -> str:
    return f"{tree} on the scenarios {start} to {stop}"
