"""The journal: what a run did, one JSON object a line, only ever appended to.

No clock times stand in it, and floats are written so that they read back exactly: the same seed gives the same bytes.
"""

from __future__ import annotations

import fcntl
import json
from typing import TYPE_CHECKING, TypeAlias

from grammarbt.errors import RunError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from io import FileIO
    from pathlib import Path

Event: TypeAlias = "Mapping[str, object]"


class Journal:
    """A journal open for appending, locked against other processes.

    Use `Journal.open`; it cuts a torn last line, which a killed process may have left.

    Attributes:
        events: how many stand in it.
    """

    def __init__(self, file: FileIO, events: int) -> None:
        self.events = events
        self._file = file

    @classmethod
    def open(cls, path: Path) -> Journal:
        """Open or make a journal.

        Raises:
            RunError: it cannot be written, is in use by another run, or is damaged before its last line.
        """
        try:
            file = path.open("ab", buffering=0)
        except OSError as error:
            raise RunError(f"cannot write {str(path)!r}: {error.strerror}", "choose another folder") from None
        try:
            _lock(file, path)
            data = path.read_bytes()
            whole = data.rfind(b"\n") + 1
            events = len(_parse(data[:whole], path))
            if whole < len(data):
                file.truncate(whole)
        except BaseException:
            file.close()
            raise
        return cls(file, events)

    def append(self, events: Iterable[Event]) -> None:
        """Write events at once, so that they outlive the process.

        Raises:
            RunError: the disk is full or the folder has gone.
        """
        lines = [_line(event) for event in events]
        rest = "".join(lines).encode()
        try:
            while rest:
                rest = rest[self._file.write(rest) :]
        except OSError as error:
            raise RunError(f"cannot write {str(self._file.name)!r}: {error.strerror}", "free some space") from None
        self.events += len(lines)

    def close(self) -> None:
        """Close the file, which unlocks it."""
        self._file.close()


def read_journal(path: Path) -> list[Event]:
    """All events of a journal; a torn last line is left out.

    Raises:
        RunError: it cannot be read, or a line other than a torn last one is no JSON object.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise RunError(f"cannot read {str(path)!r}: {error.strerror}", "give the folder of a run") from None
    return _parse(data[: data.rfind(b"\n") + 1], path)


def _parse(data: bytes, path: Path) -> list[Event]:
    events: list[Event] = []
    for number, line in enumerate(data.split(b"\n")[:-1], 1):
        try:
            event = json.loads(line)
        except ValueError:
            event = None
        if not isinstance(event, dict) or "event" not in event:
            raise RunError(f"{path}, line {number}: not an event of a run", "restore the file from a backup")
        events.append(event)
    return events


def _line(event: Event) -> str:
    return json.dumps(event, ensure_ascii=False, allow_nan=False, separators=(",", ":")) + "\n"


def _lock(file: FileIO, path: Path) -> None:
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        raise RunError(f"{str(path)!r} is in use by another run", "wait for it, or choose another folder") from None
