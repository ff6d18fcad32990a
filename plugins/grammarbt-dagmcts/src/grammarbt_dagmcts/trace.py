"""The DAG of a search as GraphML, for any program that draws or analyses graphs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from grammarbt.errors import SearcherError
from grammarbt.grammar import BoundGrammar
from grammarbt.search import BlockDag, BlockNode
from grammarbt_dagmcts.dag import Dag, Node

if TYPE_CHECKING:
    import networkx as nx

Vertex: TypeAlias = Node | BlockNode


def file_of_restart(path: Path, number: int) -> Path:
    """Where the DAG goes that a restart ended: for `dag.graphml` and the second restart, `dag-2.graphml`."""
    return path.with_stem(f"{path.stem}-{number}")


def write_graphml(path: Path, grammar: BoundGrammar, dags: Iterable[Dag | BlockDag]) -> None:
    """Write the forms with what they earned, and the productions between them; a node of several parents is a transposition.

    Raises:
        SearcherError: the file cannot be written.
    """
    import networkx as nx  # noqa: PLC0415  a search without a trace need not wait for it

    graph: nx.MultiDiGraph[int] = nx.MultiDiGraph()
    for dag in dags:
        _add(graph, grammar, dag)
    for node, parents in graph.in_degree():
        graph.nodes[node]["parents"] = parents
    graph.graph["transpositions"] = sum(parents > 1 for _, parents in graph.in_degree())
    try:
        nx.write_graphml(graph, path)
    except OSError as error:
        raise SearcherError(
            f"cannot write {str(path)!r}: {error.strerror}", "set searcher.trace to another file"
        ) from None


def _add(graph: nx.MultiDiGraph[int], grammar: BoundGrammar, dag: Dag | BlockDag) -> None:
    vertices: Sequence[Vertex] = dag.nodes if isinstance(dag, Dag) else tuple(dag.nodes.values())
    numbers = {vertex: number for number, vertex in enumerate(vertices, graph.number_of_nodes())}
    for vertex, number in numbers.items():
        mean = vertex.mean if vertex.visits else 0.0
        graph.add_node(number, form=grammar.text(vertex.form), visits=vertex.visits, mean=mean)
    for vertex in vertices:
        for child, production in _edges(vertex):
            graph.add_edge(numbers[vertex], numbers[child], production=grammar.production_text(production))


def _edges(vertex: Vertex) -> Iterator[tuple[Vertex, int]]:
    if isinstance(vertex, Node):
        yield from vertex.children.values()
    else:
        yield from ((child, production) for production, child, _ in vertex.children or ())
