"""What lies behind a place is found once each, nearest first."""

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from grammarbt.grammar.reach import reachable

EDGES = st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), max_size=30)


@given(EDGES)
def test_what_is_reached_is_what_networkx_reaches_in_the_order_of_its_distance(edges):
    graph = nx.DiGraph(edges)
    graph.add_node(0)
    found = list(reachable(0, graph.successors))
    distance = nx.single_source_shortest_path_length(graph, 0)
    assert sorted(found) == sorted(distance)
    assert [distance[place] for place in found] == sorted(distance.values())


def test_no_more_is_asked_than_the_caller_looks_at():
    asked = []
    places = reachable(0, lambda place: asked.append(place) or [place + 1])
    assert [next(places) for _ in range(3)] == [0, 1, 2]
    assert asked == [0, 1]
