"""The sea area: roadmaps, paths on them and what a sensor sees from each vertex, as tables.

Everything that needs a logarithm or an exponential is worked out here, once, so that every implementation of the
simulator adds and compares the same floating-point numbers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from attrs import frozen
from numpy.typing import NDArray

from grammarbt_marine.layouts import make_layout
from grammarbt_marine.records import Flags, Floats, Ints, Records, as_records

if TYPE_CHECKING:
    from grammarbt_marine.layouts import Layout
    from grammarbt_marine.parameters import MarineParameters

CLASSES = 3
"""Targets, mines and objects, in this order in every table by class."""

WIDTH_STEP = 8
"""Rows of neighbours are this or a multiple wide: compiled code fits one width, and few widths mean few compilations."""


@frozen(eq=False)
class Roadmap:
    """The tables of one roadmap with V vertices; rows shorter than the widest are padded with zeros.

    Attributes:
        position: (V, 2 or 3) where each vertex is, the third how deep.
        count: (3,) how many targets, mines and objects there are.
        neighbours: (V, N) the vertices joined to each vertex, ascending.
        degree: (V,) how many those are.
        distance: (V, V) cost of the cheapest path from a vertex to another; whole numbers when an edge costs one.
        next_hop: (V, V) first vertex on it, the lowest number among equals; from a vertex to itself, itself.
        surface: (V,) whether a vertex is at the surface.
        comms: (V,) whether it is in comms.
        nearest_surface: (V,) the nearest vertex at the surface, the lowest number among equals.
        nearest_comms: (V,) the nearest vertex in comms, likewise.
        sweep: (V,) all vertices in the order of a sweep over the area, lane by lane.
        in_range: (V, K) the vertices that the sensor reaches from each vertex, ascending.
        reach: (V,) how many those are.
        detection: (V, K, 3) probability to detect a target, mine, object that is at that vertex.
        gain: (V, K, 3) what a detection adds to the log odds of a target, mine, object there.
        loss: (V, K, 3) what no detection adds to them; negative when the sensor is any good.
    """

    position: Floats
    count: Ints
    neighbours: Ints
    degree: Ints
    distance: Ints | Floats
    next_hop: Ints
    surface: Flags
    comms: Flags
    nearest_surface: NDArray[np.int64]
    nearest_comms: NDArray[np.int64]
    sweep: Ints
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
    """One roadmap, and how many things there are on it."""
    layout = make_layout(parameters, rng)
    comms = layout.surface & (layout.lengths[0] <= parameters.comms_range)
    distance, next_hop = _paths(layout, parameters)
    sensed = layout.lengths <= parameters.sensor_range
    in_range = _places(sensed)
    return Roadmap(
        position=layout.positions,
        count=_things(parameters, rng),
        neighbours=_places(layout.joined),
        degree=_counts(layout.joined),
        distance=distance,
        next_hop=next_hop,
        surface=layout.surface,
        comms=comms,
        nearest_surface=_nearest(layout.surface, distance),
        nearest_comms=_nearest(comms, distance),
        sweep=_sweep(layout.positions, 2.0 * parameters.sensor_range),
        in_range=in_range,
        reach=_counts(sensed),
        **_sensor(np.take_along_axis(layout.lengths, in_range.astype(np.int64), axis=1), parameters),
    )


def _things(parameters: MarineParameters, rng: np.random.Generator) -> Ints:
    """How many things of each class there are; where chance decides, drawn until each class is present."""
    p = parameters
    count = np.array([p.targets, p.mines, p.objects])
    odds = [*(p.thing_share / CLASSES,) * CLASSES, 1.0 - p.thing_share]
    while p.thing_share and not (count := rng.multinomial(p.vertices - 2, odds)[:CLASSES]).all():
        pass
    return count.astype(np.int16)


def _paths(layout: Layout, parameters: MarineParameters) -> tuple[Ints | Floats, Ints]:
    """Cheapest paths between all pairs (Floyd and Warshall), and the lowest neighbour on each; all are connected."""
    joined, lengths = layout.joined, layout.lengths
    edge = lengths if parameters.edge_cost == "length" else np.ones(lengths.shape, dtype=np.int16)
    distance = np.where(joined, edge, edge.max() * len(edge))
    np.fill_diagonal(distance, 0)
    for via in range(len(distance)):
        np.minimum(distance, distance[:, via, None] + distance[via], out=distance)
    next_hop = np.empty(joined.shape, dtype=np.int16)
    for vertex, near in enumerate(map(np.flatnonzero, joined)):
        next_hop[vertex] = near[(edge[vertex, near, None] + distance[near]).argmin(axis=0)]
    np.fill_diagonal(next_hop, np.arange(len(distance)))
    return distance, next_hop


def _nearest(flags: Flags, distance: Ints | Floats) -> NDArray[np.int64]:
    """From each vertex the nearest that is flagged; argmin finds the first."""
    return np.asarray(np.flatnonzero(flags)[distance[:, flags].argmin(axis=1)])


def _sweep(positions: Floats, lane: float) -> Ints:
    """All vertices by lanes of that width from left to right, in turn upwards and downwards."""
    number = (positions[:, 0] // lane).astype(np.int64)
    along = np.where(number % 2 == 0, positions[:, 1], -positions[:, 1])
    return np.lexsort((along, number)).astype(np.int16)


def _sensor(lengths: Floats, parameters: MarineParameters) -> dict[str, Floats]:
    """Detection probabilities and log likelihood ratios; `lengths` is (V, K)."""
    p = parameters
    false_alarm = np.array([p.target_pf, p.mine_pf, p.object_pf])
    at_vertex = np.array([p.target_pd, p.mine_pd, p.object_pd])
    reach = np.exp(-((lengths / p.sensor_scale) ** 2))[:, :, None]
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
