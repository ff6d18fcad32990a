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

from grammarbt.errors import RunError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping
    from io import FileIO
    from pathlib import Path

Event: TypeAlias = "Mapping[str, object]"

_TAIL = len(',"crc":"00000000"}\n')


class Journal:
    """A journal open for writing, locked against other processes.

    A journal that holds events already is repeated: what is appended must be what stands there, byte by byte, and is
    written only beyond its end. Use `Journal.open`; it cuts a torn last line, which a killed process may have left.

    Attributes:
        events: how many were appended or repeated.
    """

    def __init__(self, file: FileIO, path: Path, keep: int | None, extended: Callable[[], None]) -> None:
        self.events = 0
        self._file = file
        self._path = path
        self._extended = extended
        self._crc = self._size = 0
        self._old: Iterator[bytes] | None = islice(_lines(path), keep)

    @classmethod
    def open(cls, path: Path, keep: int | None = None, extended: Callable[[], None] = lambda: None) -> Journal:
        """Open or make a journal.

        Args:
            path: its file.
            keep: how many of its events to repeat; None for all. The others are cut off when the first is written.
            extended: called just before the first event is written.

        Raises:
            RunError: it cannot be written, is in use by another run, or is damaged before its last line.
        """
        try:
            file = path.open("ab", buffering=0)
        except OSError as error:
            raise RunError(f"cannot write {str(path)!r}: {error.strerror}", "choose another folder") from None
        try:
            _lock(file, path)
            whole = sum(len(line) for line in _lines(path))
            if whole < path.stat().st_size:
                file.truncate(whole)
        except BaseException:
            file.close()
            raise
        return cls(file, path, keep, extended)

    @property
    def repeating(self) -> bool:
        """Whether nothing new has been written yet to a journal that held events."""
        return self._old is not None

    def append(self, events: Iterable[Event]) -> None:
        """Write events at once, so that they outlive the process; or see that they stand there already.

        Raises:
            RunError: the disk is full, the folder has gone, or another event stands there.
        """
        fresh = b"".join([line for line in map(self._line, events) if not self._repeats(line)])
        if fresh:
            self._write(fresh)

    def close(self) -> None:
        """Close the file, which unlocks it."""
        self._file.close()

    def _line(self, event: Event) -> bytes:
        body = json.dumps(event, ensure_ascii=False, allow_nan=False, separators=(",", ":"))[:-1].encode()
        self._crc = crc32(body, self._crc)
        return body + _tail(self._crc)

    def _repeats(self, line: bytes) -> bool:
        self.events += 1
        old = None if self._old is None else next(self._old, None)
        if old is None:
            self._finish_old()
            return False
        if old != line:
            raise RunError(
                f"{self._path}, line {self.events}: the run does not repeat itself",
                "resume with the versions and files that the run began with",
            )
        self._size += len(line)
        return True

    def _finish_old(self) -> None:
        if self._old is not None:
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


def iterate_journal(path: Path) -> Iterator[Event]:
    """As `read_journal`, one by one, for journals larger than the memory."""
    return (json.loads(line[:-_TAIL] + b"}") for line in _lines(path))


def _lines(path: Path) -> Iterator[bytes]:
    """The whole lines of a journal, each checked."""
    crc = 0
    try:
        with path.open("rb") as file:
            for number, line in enumerate(file, 1):
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
