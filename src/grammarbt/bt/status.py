"""What a tick answers."""

from __future__ import annotations

from enum import IntEnum


class Status(IntEnum):
    """The three answers of a node; the numbers are those compiled simulators return."""

    FAILURE = 0
    SUCCESS = 1
    RUNNING = 2
