"""Which cluster."""

from __future__ import annotations

from attrs import field, frozen
from attrs.validators import gt, matches_re, optional


@frozen
class DaskParameters:
    """Parameters of the executor `dask`."""

    address: str | None = field(
        default=None,
        validator=optional(matches_re(r"[a-z]+://.+")),
        metadata={"help": "a running scheduler, as tcp://HOST:PORT; none starts worker processes on this machine"},
    )
    patience: float = field(
        default=60.0,
        validator=gt(0),
        metadata={
            "help": "seconds to wait for the scheduler and its first worker, and, on this machine, for one in the place of all that died"
        },
    )
