"""Lines that came from a program: read as JSON objects, and shown to people."""

from __future__ import annotations

import json

_SHOWN = 200


def read_object(line: bytes) -> dict[str, object]:
    """The JSON object in a line.

    Raises:
        ValueError: there is none; the text says why.
    """
    try:
        found: object = json.loads(line)
    except UnicodeDecodeError as error:
        raise ValueError(f"byte {error.start} is not UTF-8") from None
    except (ValueError, RecursionError) as error:
        raise ValueError(f"no JSON, {error}") from None
    if not isinstance(found, dict):
        raise ValueError("no JSON object")  # noqa: TRY004 - the line is at fault, not a type
    return found


def shown(line: bytes) -> str:
    """A line for an error's message, in one piece and not too long."""
    text = line.decode(errors="backslashreplace")
    return repr(text if len(text) <= _SHOWN else text[:_SHOWN] + "…")
