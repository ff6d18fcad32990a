import networkx as nx
import pytest

from grammarbt.errors import SearcherError
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt_dagmcts.parameters import DagMctsParameters
from grammarbt_dagmcts.search import DagMcts


@pytest.mark.parametrize("preset", ["default", "paper", "mcdags"])
def test_the_trace_holds_every_node_with_what_it_earned(search, tmp_path, preset):
    path = tmp_path / "dag.graphml"
    searcher, _ = search(150, preset=preset, restarts=False, trace=str(path))
    searcher.candidates(1)
    graph = nx.read_graphml(path)
    assert len(graph) == searcher.metrics()["nodes"]
    assert nx.is_directed_acyclic_graph(graph)
    assert max(visits for _, visits in graph.nodes(data="visits")) > 5
    assert all(parents == graph.in_degree(node) for node, parents in graph.nodes(data="parents"))
    assert all("⇒" in production for _, _, production in graph.edges(data="production"))


def test_the_papers_trace_shows_transpositions(search, tmp_path):
    path = tmp_path / "dag.graphml"
    searcher, _ = search(150, preset="paper", restart_every=0, trace=str(path))
    searcher.candidates(1)
    graph = nx.read_graphml(path)
    assert graph.number_of_edges() == searcher.metrics()["edges"]
    assert max(dict(graph.in_degree()).values()) > 1
    assert graph.graph["transpositions"] == sum(parents > 1 for _, parents in graph.nodes(data="parents"))


@pytest.mark.parametrize(
    "changes", [{"preset": "paper", "restart_every": 60}, {"preset": "mcdags", "round_length": 60}]
)
def test_the_dag_that_a_restart_ends_has_a_trace_of_its_own(search, tmp_path, changes):
    path = tmp_path / "dag.graphml"
    searcher, _ = search(150, trace=str(path), **changes)
    searcher.candidates(1)
    assert searcher.metrics()["restarts"] == 2
    assert sorted(file.name for file in tmp_path.iterdir()) == ["dag-1.graphml", "dag-2.graphml", "dag.graphml"]
    graphs = [nx.read_graphml(tmp_path / name) for name in ("dag-1.graphml", "dag-2.graphml", "dag.graphml")]
    assert [visits_of_root(graph) for graph in graphs] == [60, 60, 30]


def visits_of_root(graph):
    return graph.nodes[next(node for node, parents in graph.nodes(data="parents") if parents == 0)]["visits"]


def test_a_trace_into_no_folder_is_an_error_before_the_search(context, tmp_path):
    with pytest.raises(SearcherError, match="no folder"):
        DagMcts(context(), DagMctsParameters(trace=str(tmp_path / "missing" / "dag.graphml")))


def test_a_trace_that_cannot_be_written_is_one_line(search, tmp_path):
    searcher, _ = search(20, preset="paper", trace=str(tmp_path))
    with pytest.raises(SearcherError, match="cannot write"):
        searcher.candidates(1)


def test_without_a_dag_there_is_nothing_to_trace(context, vocabulary, tmp_path):
    text = '%declare ACTION CONDITION\nstart: ACTION | "→" "(" CONDITION start ")"\n%limit nodes 7\n'
    nested = bind(load_grammar(Source("nested.grammar", text)), vocabulary)
    with pytest.raises(SearcherError, match="no DAG"):
        DagMcts(context(grammar=nested), DagMctsParameters(trace=str(tmp_path / "dag.graphml")))
