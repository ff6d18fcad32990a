"""What the command line prints: results on standard output, everything else on standard error."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence


def emit_json(result: Mapping[str, object]) -> None:
    """Print the one JSON object of `--json`."""
    print(json.dumps(result, ensure_ascii=False))


def warn(message: str) -> None:
    """Print one line that does not belong to the result."""
    print(f"warning: {message}", file=sys.stderr)


def table(rows: Iterable[Sequence[str]]) -> str:
    """The rows as lines with aligned columns; the last column is free."""
    lines = [tuple(row) for row in rows]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)][:-1]
    return "\n".join(_aligned(line, widths) for line in lines)


def _aligned(row: Sequence[str], widths: Sequence[int]) -> str:
    return "  ".join([*(cell.ljust(width) for cell, width in zip(row, widths, strict=False)), row[-1]]).rstrip()
