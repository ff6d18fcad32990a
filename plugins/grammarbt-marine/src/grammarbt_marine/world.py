"""The sea area: roadmaps, distances on them and what a sensor sees from each vertex, as tables.

Everything that needs a logarithm or an exponential is worked out here, once, so that every implementation of the
simulator adds and compares the same floating-point numbers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from attrs import frozen

from grammarbt_marine.records import Flags, Floats, Ints, Records, as_records

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from grammarbt_marine.parameters import MarineParameters

START, DROP_OFF = 0, 1
WIDTH_STEP = 8
"""Rows of neighbours are this or a multiple wide: compiled code fits one width, and few widths mean few compilations."""


@frozen(eq=False)
class Roadmap:
    """The tables of one roadmap with V vertices; rows shorter than the widest are padded with zeros.

    Attributes:
        neighbours: (V, N) the vertices joined to each vertex, ascending.
        degree: (V,) how many those are.
        hops: (V, V) edges on the shortest path from a vertex to another.
        next_hop: (V, V) first vertex on it, the lowest number among equals; from a vertex to itself, itself.
        surface: (V,) whether a vertex is at the surface.
        comms: (V,) whether it is in comms.
        nearest_comms: (V,) the nearest vertex in comms, the lowest number among equals.
        in_range: (V, K) the vertices that the sensor reaches from each vertex, ascending.
        reach: (V,) how many those are.
        detection: (V, K, 3) probability to detect a target, mine, object that is at that vertex.
        gain: (V, K, 3) what a detection adds to the log odds of a target, mine, object there.
        loss: (V, K, 3) what no detection adds to them; negative when the sensor is any good.
    """

    neighbours: Ints
    degree: Ints
    hops: Ints
    next_hop: Ints
    surface: Flags
    comms: Flags
    nearest_comms: Ints
    in_range: Ints
    reach: Ints
    detection: Floats
    gain: Floats
    loss: Floats


def make_roadmaps(parameters: MarineParameters) -> Records:
    """All roadmaps, as records with the fields of `Roadmap`; roadmap i does not depend on how many there are."""
    seeds = np.random.SeedSequence(parameters.roadmap_seed).spawn(parameters.roadmaps)
    return as_records([make_roadmap(parameters, np.random.default_rng(seed)) for seed in seeds])


def make_roadmap(parameters: MarineParameters, rng: np.random.Generator) -> Roadmap:
    """One roadmap: vertices uniform in the unit square, joined to their nearest, connected by the shortest gaps."""
    positions = rng.random((parameters.vertices, 2))
    positions[START] = parameters.start_x, parameters.start_y
    positions[DROP_OFF] = parameters.drop_off_x, parameters.drop_off_y
    surface = rng.random(parameters.vertices) < parameters.surface_share
    surface[START] = True
    distances = np.sqrt(((positions[:, None] - positions) ** 2).sum(axis=-1))
    joined = _connected(_nearest_joined(distances, parameters.neighbours), distances)
    comms = surface & (distances[START] <= parameters.comms_range)
    hops = _hops(joined)
    sensed = distances <= parameters.sensor_range
    in_range = _places(sensed)
    return Roadmap(
        neighbours=_places(joined),
        degree=_counts(joined),
        hops=hops,
        next_hop=_next_hops(joined, hops),
        surface=surface,
        comms=comms,
        nearest_comms=np.flatnonzero(comms)[hops[:, comms].argmin(axis=1)].astype(np.int16),
        in_range=in_range,
        reach=_counts(sensed),
        **_sensor(np.take_along_axis(distances, in_range.astype(np.int64), axis=1), parameters),
    )


def _nearest_joined(distances: Floats, neighbours: int) -> Flags:
    """Join each vertex to its nearest ones; the roadmap is undirected."""
    others = distances + np.diag(np.full(len(distances), np.inf))
    nearest = others.argsort(axis=1, kind="stable")[:, : min(neighbours, len(distances) - 1)]
    joined = np.zeros(distances.shape, dtype=np.bool_)
    np.put_along_axis(joined, nearest, values=True, axis=1)
    return joined | joined.T


def _connected(joined: Flags, distances: Floats) -> Flags:
    """Join the two nearest vertices of different components until there is one component."""
    joined = joined.copy()
    while True:
        component = _components(joined)
        gaps = np.where(component[:, None] == component, np.inf, distances)
        here, there = np.unravel_index(gaps.argmin(), gaps.shape)
        if np.isinf(gaps[here, there]):
            return joined
        joined[here, there] = joined[there, here] = True


def _components(joined: Flags) -> NDArray[np.int64]:
    """The lowest vertex of each vertex's component."""
    lowest = np.arange(len(joined))
    while True:
        lower = np.minimum(lowest, np.where(joined, lowest, len(joined)).min(axis=1))
        if (lower == lowest).all():
            return lowest
        lowest = lower


def _hops(joined: Flags) -> Ints:
    """Edges between all pairs (Floyd and Warshall); the roadmap is connected."""
    hops = np.where(joined, 1, len(joined)).astype(np.int16)
    np.fill_diagonal(hops, 0)
    for via in range(len(joined)):
        np.minimum(hops, hops[:, via, None] + hops[via], out=hops)
    return hops


def _next_hops(joined: Flags, hops: Ints) -> Ints:
    """The lowest neighbour that is one edge nearer; argmax finds the first."""
    rows = [(joined[vertex, :, None] & (hops == hops[vertex] - 1)).argmax(axis=0) for vertex in range(len(joined))]
    first = np.array(rows, dtype=np.int16)
    np.fill_diagonal(first, np.arange(len(joined)))
    return first


def _sensor(distances: Floats, parameters: MarineParameters) -> dict[str, Floats]:
    """Detection probabilities and log likelihood ratios; `distances` is (V, K)."""
    p = parameters
    false_alarm = np.array([p.target_pf, p.mine_pf, p.object_pf])
    at_vertex = np.array([p.target_pd, p.mine_pd, p.object_pd])
    reach = np.exp(-((distances / p.sensor_scale) ** 2))[:, :, None]
    detection = false_alarm + (at_vertex - false_alarm) * reach
    return {
        "detection": detection,
        "gain": np.log(detection / false_alarm),
        "loss": np.log((1.0 - detection) / (1.0 - false_alarm)),
    }


def _counts(flags: Flags) -> Ints:
    """How many places are set in each row."""
    return np.asarray(flags.sum(axis=1), dtype=np.int16)


def _places(flags: Flags) -> Ints:
    """The places that are set in each row, ascending."""
    width = -(-flags.sum(axis=1).max() // WIDTH_STEP) * WIDTH_STEP
    rows = np.zeros((len(flags), width), dtype=np.int16)
    for row, flagged in zip(rows, flags, strict=True):
        places = np.flatnonzero(flagged)
        row[: len(places)] = places
    return rows
