"""A comparison as text, CSV and JSON."""

from __future__ import annotations

import csv
import json
from io import StringIO
from typing import TYPE_CHECKING

from attrs import asdict

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grammarbt.report.comparison import Comparison, Pair, Row
    from grammarbt.report.statistics import Interval

HEAD = ("domain", "searcher", "runs", "value (IQM)", "95 %", "ratio", "95 %", "worst", "complete", "target", "rank")
PAIR_HEAD = ("domain", "first", "second", "P(first better)", "95 %", "difference", "p (Holm)")


def as_text(comparison: Comparison) -> str:
    """Aligned columns: the rows, then the pairs."""
    parts = [aligned([HEAD, *(row_cells(row) for row in comparison.rows)])]
    if comparison.pairs:
        parts.append(aligned([PAIR_HEAD, *(pair_cells(pair) for pair in comparison.pairs)]))
    return "\n\n".join(parts) + "\n"


def as_csv(comparison: Comparison) -> str:
    """One line per domain and searcher, with every figure in full."""
    rows = [_flat(asdict(row)) for row in comparison.rows]
    out = StringIO()
    if rows:
        writer = csv.DictWriter(out, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return out.getvalue()


def as_json(comparison: Comparison) -> str:
    """Everything."""
    return json.dumps(asdict(comparison), ensure_ascii=False, indent=1) + "\n"


def row_cells(row: Row) -> tuple[str, ...]:
    """A row's figures, rounded for reading."""
    return (
        row.domain,
        row.searcher,
        str(row.runs),
        f"{row.value.value:.5g}",
        _ends(row.value, ".5g"),
        "-" if row.ratio is None else f"{row.ratio.value:.3f}",
        "-" if row.ratio is None else _ends(row.ratio, ".3f"),
        f"{row.worst:.5g}",
        "-" if row.complete is None else f"{row.complete.value:.0%}",
        "-" if row.episodes is None else f"{row.episodes:,.0f}",
        "-" if row.rank is None else f"{row.rank:.2f}",
    )


def pair_cells(pair: Pair) -> tuple[str, ...]:
    """A pair's figures, rounded for reading."""
    return (
        pair.domain,
        pair.first,
        pair.second,
        f"{pair.better.value:.2f}",
        _ends(pair.better, ".2f"),
        f"{pair.difference:+.4g}",
        f"{pair.p_value:.3g}",
    )


def aligned(rows: Sequence[Sequence[str]]) -> str:
    """Columns of equal width; the first row stands apart."""
    widths = [max(len(row[at]) for row in rows) for at in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    return "\n".join([lines[0], "-" * len(lines[0]), *lines[1:]])


def _ends(interval: Interval, form: str) -> str:
    return f"{interval.low:{form}} to {interval.high:{form}}"


def _flat(values: dict[str, object]) -> dict[str, object]:
    found: dict[str, object] = {}
    for key, value in values.items():
        if isinstance(value, dict):
            found.update({f"{key}_{part}": number for part, number in value.items()})
        elif key in ("ratio", "complete", "reached"):
            found.update(dict.fromkeys((f"{key}_value", f"{key}_low", f"{key}_high"), ""))
        else:
            found[key] = "" if value is None else value
    return found
