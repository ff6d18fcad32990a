"""Which program, and how long it may take."""

from __future__ import annotations

from attrs import field, frozen
from attrs.validators import gt, min_len


@frozen
class ExecParameters:
    """Parameters of the domain `exec`; times in seconds."""

    command: str = field(
        validator=min_len(1),
        metadata={"help": "the program and its arguments, quoted as for a shell, which is not started"},
    )
    timeout: float = field(
        default=60.0,
        validator=gt(0),
        metadata={"help": "seconds that the answer to one request may take; then the program is killed"},
    )
    startup: float = field(
        default=60.0,
        validator=gt(0),
        metadata={"help": "seconds from its start that the program may take to announce itself"},
    )
