"""Amounts of limited things, as vectors, and sets of them in which none is at most another."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

Vector: TypeAlias = tuple[tuple[int, int], ...]
"""(dimension, amount) pairs in order of dimension; amounts are above 0."""

Antichain: TypeAlias = tuple[Vector, ...]
NOTHING: Antichain = ((),)


def minimal(vectors: Iterable[Vector]) -> Antichain:
    """The vectors that no other one undercuts, in a fixed order."""
    found: list[Vector] = []
    by_first: dict[int, list[Vector]] = {}
    for vector in sorted(set(vectors), key=lambda v: (sum(amount for _, amount in v), v)):
        if not vector:
            return NOTHING
        # only a vector whose first dimension this one has too can undercut it
        if not any(undercut(vector, by_first.get(dimension, ())) for dimension, _ in vector):
            found.append(vector)
            by_first.setdefault(vector[0][0], []).append(vector)
    return tuple(found)


def undercut(vector: Vector, others: Iterable[Vector]) -> bool:
    """Whether one of the others needs no more of anything."""
    amounts = dict(vector)
    return any(all(amount <= amounts.get(dimension, 0) for dimension, amount in other) for other in others)


def add(one: Vector, other: Vector) -> Vector:
    """Amount by amount."""
    if not one or not other:
        return one or other
    amounts = dict(one)
    for dimension, amount in other:
        amounts[dimension] = amounts.get(dimension, 0) + amount
    return tuple(sorted(amounts.items()))
