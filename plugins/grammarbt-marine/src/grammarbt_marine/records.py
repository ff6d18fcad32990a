"""Tables as NumPy records, the form in which the compiled simulator reads and writes them.

A record is one block of memory: compiled functions hand it on as a pointer, where tuples of arrays would cost them a
reference count per array and call (measured: five sixths of the time of an episode).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from attrs import fields
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    from attrs import AttrsInstance

Ints: TypeAlias = NDArray[np.int16]
Floats: TypeAlias = NDArray[np.float64]
Flags: TypeAlias = NDArray[np.bool_]
Records: TypeAlias = NDArray[np.void]


def as_records(rows: Sequence[AttrsInstance]) -> Records:
    """One record per attrs instance, with its fields; tables of different widths are padded with zeros."""
    names = [attribute.name for attribute in fields(type(rows[0]))]
    columns = [[_storable(getattr(row, name)) for row in rows] for name in names]
    layout: list[Any] = [(name, column[0].dtype, _shape(column)) for name, column in zip(names, columns, strict=True)]
    records = np.zeros(len(rows), dtype=np.dtype(layout, align=True))
    for name, column in zip(names, columns, strict=True):
        for row, table in enumerate(column):
            records[name][(row, *(slice(size) for size in table.shape))] = table
    return records


def _storable(value: object) -> NDArray[Any]:
    """Truth values become 0 and 1; numba knows no records with arrays of truth values."""
    table = np.asarray(value)
    return table.astype(np.int8) if table.dtype == np.bool_ else table


def _shape(tables: Sequence[NDArray[Any]]) -> tuple[int, ...]:
    """The smallest shape that holds every table."""
    return tuple(max(sizes) for sizes in zip(*(table.shape for table in tables), strict=True))
