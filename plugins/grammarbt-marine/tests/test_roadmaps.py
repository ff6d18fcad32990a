"""The roadmaps are what the parameters say."""

from itertools import product

import networkx as nx
import numpy as np
import pytest

from grammarbt_marine.layouts import DROP_OFF, START
from grammarbt_marine.parameters import MarineParameters
from grammarbt_marine.world import make_roadmap, make_roadmaps

ROADMAPS = range(0, 256, 37)


def graph_of(roadmap):
    graph = nx.Graph()
    for vertex, (row, degree) in enumerate(zip(roadmap["neighbours"], roadmap["degree"], strict=True)):
        graph.add_edges_from((vertex, int(other)) for other in row[:degree])
    return graph


@pytest.mark.parametrize("number", ROADMAPS)
def test_paths_are_shortest_and_ties_go_to_the_lowest_vertex(marine, number):
    roadmap = marine.roadmaps[number]
    graph = graph_of(roadmap)
    hops = dict(nx.all_pairs_shortest_path_length(graph))
    for here in graph:
        for there in graph:
            assert roadmap["distance"][here, there] == hops[here][there]
            nearer = [vertex for vertex in graph[here] if hops[vertex][there] < hops[here][there]]
            assert roadmap["next_hop"][here, there] == (min(nearer) if nearer else here)


@pytest.mark.parametrize("number", ROADMAPS)
def test_every_vertex_is_joined_to_four_others_and_all_are_connected(marine, number):
    graph = graph_of(marine.roadmaps[number])
    assert nx.is_connected(graph)
    assert min(degree for _, degree in graph.degree) >= marine.parameters.neighbours
    assert sorted(graph) == list(range(marine.parameters.vertices))


class FixedPositions:
    """Stands in for a generator: hands out these vertices, all of them at the surface."""

    def __init__(self, positions):
        self.positions = positions

    def random(self, shape):
        return self.positions.copy() if shape == self.positions.shape else np.zeros(shape)


def test_far_clusters_are_joined_by_their_shortest_gap_alone():
    home = np.arange(12) % 2  # even vertices near the start, odd ones near the drop-off
    positions = np.where(home == 0, 0.1, 0.9)[:, None] + 0.1 * np.random.default_rng(3).random((12, 2))
    positions[START], positions[DROP_OFF] = 0.1, 0.9
    ends = {"start_x": 0.1, "start_y": 0.1, "drop_off_x": 0.9, "drop_off_y": 0.9}
    parameters = MarineParameters(vertices=12, neighbours=2, targets=1, mines=1, objects=1, **ends)
    hops = make_roadmap(parameters, FixedPositions(positions)).distance
    across = [(here, there) for here in range(0, 12, 2) for there in range(1, 12, 2) if hops[here, there] == 1]
    gaps = np.linalg.norm(positions[:, None] - positions, axis=-1)
    assert across == [min(product(range(0, 12, 2), range(1, 12, 2)), key=lambda pair: gaps[pair])]


def test_the_start_is_in_comms_and_comms_is_near_the_start_at_the_surface(marine):
    roadmaps = marine.roadmaps
    assert roadmaps["comms"][:, START].all()
    assert not (roadmaps["comms"] & ~roadmaps["surface"] & 1).any()
    assert roadmaps["surface"].mean() == pytest.approx(marine.parameters.surface_share, abs=0.02)


def test_a_detection_speaks_for_a_thing_and_no_detection_against_it(marine):
    seen = np.arange(marine.roadmaps["in_range"].shape[2]) < marine.roadmaps["reach"][:, :, None]
    assert (marine.roadmaps["gain"][seen] > 0).all()
    assert (marine.roadmaps["loss"][seen] < 0).all()


def test_a_roadmap_does_not_depend_on_how_many_there_are():
    few, more = (make_roadmaps(MarineParameters(roadmaps=number)) for number in (2, 5))
    for name in ("distance", "next_hop", "surface", "degree"):
        assert (few[name] == more[name][:2]).all()


def test_start_and_drop_off_are_where_the_parameters_put_them():
    near = MarineParameters(drop_off_x=0.051, drop_off_y=0.051, roadmaps=4)
    assert (make_roadmaps(near)["distance"][:, START, DROP_OFF] == 1).all()


@pytest.fixture(scope="module")
def depths():
    """Parameters and roadmaps of the preset with two depths."""
    parameters = MarineParameters("scheide", roadmaps=20)
    return parameters, make_roadmaps(parameters)


def test_two_depths_are_joined_within_range_but_for_two_vertices_at_the_surface(depths):
    parameters, roadmaps = depths
    for roadmap in roadmaps[:4]:
        graph, places, surface = graph_of(roadmap), roadmap["position"], roadmap["surface"]
        lengths = np.linalg.norm(places[:, None] - places, axis=-1)
        for here in range(parameters.vertices):
            for there in range(here):
                near = lengths[here, there] <= parameters.edge_range
                assert graph.has_edge(here, there) == (near and not surface[here] * surface[there])
        assert nx.is_connected(graph)
        assert (places[:50, :2] == places[50:, :2]).all()
        assert surface.tolist() == [1] * 50 + [0] * 50


def test_paths_by_length_are_shortest(depths):
    roadmap = depths[1][0]
    graph = graph_of(roadmap)
    for here, there in graph.edges:
        graph[here][there]["length"] = np.linalg.norm(roadmap["position"][here] - roadmap["position"][there])
    lengths = dict(nx.all_pairs_dijkstra_path_length(graph, weight="length"))
    for here in graph:
        for there in graph:
            first = int(roadmap["next_hop"][here, there])
            assert roadmap["distance"][here, there] == pytest.approx(lengths[here][there])
            if here != there:
                rest = graph[here][first]["length"] + lengths[first][there]
                assert rest == pytest.approx(lengths[here][there])


def test_comms_is_within_range_of_the_origin(depths):
    parameters, roadmaps = depths
    flat = np.linalg.norm(roadmaps["position"][:, :, :2], axis=-1)
    near = (flat <= parameters.comms_range) & (roadmaps["surface"] == 1)
    assert (roadmaps["comms"] == near).all()


def test_each_class_is_present_and_nine_tenths_of_the_vertices_hold_nothing():
    count = make_roadmaps(MarineParameters("scheide", roadmaps=256))["count"]
    assert count.min() >= 1
    assert count.sum(axis=1).mean() == pytest.approx(0.1 * 98, abs=1.0)


def test_a_sweep_passes_every_vertex_once_lane_by_lane(marine):
    lane = 2 * marine.parameters.sensor_range
    for roadmap in marine.roadmaps[:3]:
        assert sorted(roadmap["sweep"]) == list(range(marine.parameters.vertices))
        x, y = roadmap["position"][roadmap["sweep"]].T
        lanes = x // lane
        assert (np.diff(lanes) >= 0).all()
        for number in np.unique(lanes):
            assert (np.diff(y[lanes == number]) * (1 if number % 2 == 0 else -1) >= 0).all()


def test_an_area_that_never_is_connected_is_joined_by_its_shortest_gaps():
    parameters = MarineParameters("scheide", vertices=8, edge_range=0.02, roadmaps=2)
    for roadmap in make_roadmaps(parameters):
        assert nx.is_connected(graph_of(roadmap))
