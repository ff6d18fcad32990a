"""Reading a file that may be anything."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.errors import FormatError

if TYPE_CHECKING:
    from pathlib import Path

MAX_BYTES = 16 * 2**20
"""Size of the largest file read; a tree of 256 levels and thousands of leaves is far smaller."""


def read_text(path: Path) -> str:
    """The text of a tree file.

    Raises:
        FormatError: the file cannot be read, is too large, or is not UTF-8 text.
    """
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        raise FormatError(f"cannot read {str(path)!r}: {error.strerror}", "check the path") from None
    if len(data) > MAX_BYTES:
        raise FormatError(f"{str(path)!r} is larger than {MAX_BYTES // 2**20} MiB", "no tree needs so much")
    return decode(data, str(path))


def decode(data: bytes, name: str) -> str:
    """The text that `data` holds; `name` is for the error.

    Raises:
        FormatError: it is not UTF-8 text.
    """
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FormatError(
            f"{name!r} is not text: byte {error.start} is not UTF-8", "give a tree as UTF-8 text"
        ) from None
    if "\0" in text:
        raise FormatError(f"{name!r} is not text: it holds zero bytes", "give a tree as UTF-8 text")
    return text
