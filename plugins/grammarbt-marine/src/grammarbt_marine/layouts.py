"""Where the vertices of a roadmap lie, and which of them are joined."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from attrs import frozen

from grammarbt_marine.records import Flags, Floats

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from grammarbt_marine.parameters import MarineParameters

START, DROP_OFF = 0, 1
_DRAWS = 100
"""After so many drawings of an area that is not connected, its parts are joined by their shortest gaps."""


@frozen(eq=False)
class Layout:
    """V vertices in the sea area.

    Attributes:
        positions: (V, 2) or (V, 3) x, y and, if they differ, how deep.
        surface: (V,) whether a vertex is at the surface.
        lengths: (V, V) distances as the crow flies.
        joined: (V, V) whether an edge joins two vertices; the roadmap is connected and undirected.
    """

    positions: Floats
    surface: Flags
    lengths: Floats
    joined: Flags


def make_layout(parameters: MarineParameters, rng: np.random.Generator) -> Layout:
    """Vertices uniform in the unit square, but for the start and the drop-off."""
    return _depths(parameters, rng) if parameters.layout == "depths" else _nearest(parameters, rng)


def _nearest(parameters: MarineParameters, rng: np.random.Generator) -> Layout:
    """Join each vertex to its nearest ones, and what is then apart by the shortest gaps."""
    positions = _points(parameters.vertices, parameters, rng)
    surface = rng.random(parameters.vertices) < parameters.surface_share
    surface[START] = True
    lengths = _lengths(positions)
    return Layout(positions, surface, lengths, _connected(_nearest_joined(lengths, parameters.neighbours), lengths))


def _depths(parameters: MarineParameters, rng: np.random.Generator) -> Layout:
    """A vertex at the surface and one below it at each point; redrawn until it is connected."""
    for _ in range(_DRAWS):
        points = _points(parameters.vertices // 2, parameters, rng)
        surface = np.arange(parameters.vertices) < len(points)
        down = np.where(surface, 0.0, parameters.depth)
        positions = np.column_stack([np.tile(points, (2, 1)), down])
        lengths = _lengths(positions)
        joined = (lengths <= parameters.edge_range) & ~(surface[:, None] & surface)
        np.fill_diagonal(joined, val=False)
        if not _components(joined).any():
            break
    return Layout(positions, surface, lengths, _connected(joined, lengths))


def _points(number: int, parameters: MarineParameters, rng: np.random.Generator) -> Floats:
    points = rng.random((number, 2))
    points[START] = parameters.start_x, parameters.start_y
    points[DROP_OFF] = parameters.drop_off_x, parameters.drop_off_y
    return points


def _lengths(positions: Floats) -> Floats:
    return np.asarray(np.sqrt(((positions[:, None] - positions) ** 2).sum(axis=-1)))


def _nearest_joined(lengths: Floats, neighbours: int) -> Flags:
    """Join each vertex to its nearest ones; the roadmap is undirected."""
    others = lengths + np.diag(np.full(len(lengths), np.inf))
    nearest = others.argsort(axis=1, kind="stable")[:, : min(neighbours, len(lengths) - 1)]
    joined = np.zeros(lengths.shape, dtype=np.bool_)
    np.put_along_axis(joined, nearest, values=True, axis=1)
    return joined | joined.T


def _connected(joined: Flags, lengths: Floats) -> Flags:
    """Join the two nearest vertices of different components until there is one component."""
    joined = joined.copy()
    while True:
        component = _components(joined)
        gaps = np.where(component[:, None] == component, np.inf, lengths)
        here, there = np.unravel_index(gaps.argmin(), gaps.shape)
        if np.isinf(gaps[here, there]):
            return joined
        joined[here, there] = joined[there, here] = True


def _components(joined: Flags) -> NDArray[np.int64]:
    """The lowest vertex of each vertex's component; zeros when there is one component."""
    lowest = np.arange(len(joined))
    while True:
        lower = np.minimum(lowest, np.where(joined, lowest, len(joined)).min(axis=1))
        if (lower == lowest).all():
            return lowest
        lowest = lower
