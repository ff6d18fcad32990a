"""The journal: what a run did, one JSON object a line, only ever appended to.

No clock times stand in it, and floats are written so that they read back exactly: the same seed gives the same bytes.
Each line ends with a CRC of itself and all lines before it, so that no damage goes unnoticed.
"""

from __future__ import annotations

import contextlib
import fcntl
import json
from itertools import islice
from typing import TYPE_CHECKING, TypeAlias
from zlib import crc32

from attrs import frozen

from grammarbt.errors import RunError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping
    from io import FileIO
    from pathlib import Path

Event: TypeAlias = "Mapping[str, object]"

_TAIL = len(',"crc":"00000000"}\n')
encoded = json.JSONEncoder(ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode
"""An event as it stands in a journal, without the CRC."""


@frozen
class Position:
    """A place between two lines of a journal: how many events and bytes come before it, and the CRC of those."""

    events: int
    size: int
    crc: int


START = Position(0, 0, 0)


class Journal:
    """A journal open for writing, locked against other processes.

    A journal that holds events already is repeated: what is appended must be what stands there, byte by byte, and is
    written only beyond its end. Use `Journal.open`; it cuts a torn last line, which a killed process may have left.
    """

    def __init__(
        self, file: FileIO, path: Path, keep: int | None, extended: Callable[[], None], start: Position
    ) -> None:
        self._file = file
        self._path = path
        self._extended = extended
        self._events, self._size, self._crc = start.events, start.size, start.crc
        self._old: Iterator[bytes] | None = _lines(path, keep, start)

    @classmethod
    def open(
        cls, path: Path, keep: int | None = None, extended: Callable[[], None] = lambda: None, start: Position = START
    ) -> Journal:
        """Open or make a journal.

        Args:
            path: its file.
            keep: how many of its events to repeat; None for all. The others are cut off when the first is written.
            extended: called just before the first event is written.
            start: from where on to repeat.

        Raises:
            RunError: it cannot be written, is in use by another run, or is damaged before its last line.
        """
        try:
            file = path.open("ab", buffering=0)
        except OSError as error:
            raise RunError(f"cannot write {str(path)!r}: {error.strerror}", "choose another folder") from None
        try:
            _lock(file, path)
            whole = sum(map(len, _lines(path)))
            if whole < path.stat().st_size:
                file.truncate(whole)
        except BaseException:
            file.close()
            raise
        return cls(file, path, keep, extended, start)

    @property
    def position(self) -> Position:
        """Where the next event goes."""
        return Position(self._events, self._size, self._crc)

    @property
    def repeating(self) -> bool:
        """Whether nothing new has been written yet to a journal that held events."""
        return self._old is not None

    def append(self, events: Iterable[str]) -> None:
        """Write events at once, so that they outlive the process; or see that they stand there already.

        Args:
            events: each as `encoded` gives it.

        Raises:
            RunError: the disk is full, the folder has gone, or another event stands there.
        """
        lines = map(self._line, events)
        fresh = b"".join([line for line in lines if not self._repeats(line)] if self.repeating else lines)
        if fresh:
            self._write(fresh)

    def close(self) -> None:
        """Close the file, which unlocks it."""
        self._file.close()

    def _line(self, event: str) -> bytes:
        body = event[:-1].encode()
        self._events += 1
        self._crc = crc32(body, self._crc)
        return body + _tail(self._crc)

    def _repeats(self, line: bytes) -> bool:
        if self._old is None:
            return False
        old = next(self._old, None)
        if old is None:
            self._finish_old()
            return False
        if old != line:
            raise RunError(
                f"{self._path}, line {self._events}: the run does not repeat itself",
                "resume with the versions and files that the run began with",
            )
        self._size += len(line)
        return True

    def _finish_old(self) -> None:
        self._old = None
        self._file.truncate(self._size)
        self._extended()

    def _write(self, data: bytes) -> None:
        rest = data
        try:
            while rest:
                rest = rest[self._file.write(rest) :]
        except OSError as error:
            with contextlib.suppress(OSError):
                self._file.truncate(self._size)  # a line half written would be cut later anyway
            raise RunError(f"cannot write {str(self._path)!r}: {error.strerror}", "free some space") from None
        self._size += len(data)


def read_journal(path: Path) -> list[Event]:
    """All events of a journal; a torn last line is left out.

    Raises:
        RunError: it cannot be read, or a line other than a torn last one is damaged.
    """
    return list(iterate_journal(path))


def iterate_journal(path: Path, keep: int | None = None, start: Position = START) -> Iterator[Event]:
    """As `read_journal`, one by one, for journals larger than the memory.

    Args:
        path: the journal.
        keep: the number of the event to stop after, counted from the journal's beginning; None for the last.
        start: where to begin.
    """
    return (json.loads(line[:-_TAIL] + b"}") for line in _lines(path, keep, start))


def events_after(path: Path, start: Position, most: int) -> tuple[list[Event], Position]:
    """At most so many events after a position, and the position after them: for following a run that goes on.

    Raises:
        RunError: as `read_journal`.
    """
    lines = list(_lines(path, start.events + most, start))
    if not lines:
        return [], start
    end = Position(start.events + len(lines), start.size + sum(map(len, lines)), int(lines[-1][-11:-3], 16))
    return [json.loads(line[:-_TAIL] + b"}") for line in lines], end


def holds(path: Path, position: Position) -> bool:
    """Whether a journal passes through a position.

    Raises:
        RunError: as `read_journal`.
    """
    size, crc, events = 0, b"%08x" % 0, 0
    for line in _lines(path, position.events):
        size, crc, events = size + len(line), line[-11:-3], events + 1
    return (events, size, crc) == (position.events, position.size, b"%08x" % position.crc)


def _lines(path: Path, keep: int | None = None, start: Position = START) -> Iterator[bytes]:
    """The whole lines of a journal from a position on, each checked, to the one numbered `keep`."""
    crc = start.crc
    try:
        with path.open("rb") as file:
            file.seek(start.size)
            for number, line in enumerate(
                islice(file, None if keep is None else keep - start.events), start.events + 1
            ):
                if not line.endswith(b"\n"):
                    return
                crc = crc32(line[:-_TAIL], crc)
                if line[-_TAIL:] != _tail(crc):
                    raise RunError(f"{path}, line {number}: damaged", "restore the file from a backup")
                yield line
    except OSError as error:
        raise RunError(f"cannot read {str(path)!r}: {error.strerror}", "give the folder of a run") from None


def _tail(crc: int) -> bytes:
    return b',"crc":"%08x"}\n' % crc


def _lock(file: FileIO, path: Path) -> None:
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        raise RunError(f"{str(path)!r} is in use by another run", "wait for it, or choose another folder") from None
