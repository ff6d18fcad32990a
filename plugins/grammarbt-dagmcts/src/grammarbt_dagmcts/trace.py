"""The DAG of a search as GraphML, for any program that draws or analyses graphs."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from grammarbt.errors import SearcherError
from grammarbt.grammar import BoundGrammar, SententialForm
from grammarbt.search import BlockDag
from grammarbt_dagmcts.dag import Dag

if TYPE_CHECKING:
    import networkx as nx

Vertex: TypeAlias = tuple[SententialForm, int, float]
"""A form, its visits and its mean reward."""

Edge: TypeAlias = tuple[int, int, int]
"""Parent and child, by their place among the vertices, and the production between them."""


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
    before = graph.number_of_nodes()
    vertices, edges = _of_forms(dag) if isinstance(dag, Dag) else _of_blocks(dag)
    for number, (form, visits, mean) in enumerate(vertices, before):
        graph.add_node(number, form=grammar.text(form), visits=visits, mean=mean)
    for parent, child, production in edges:
        graph.add_edge(before + parent, before + child, production=grammar.production_text(production))


def _of_forms(dag: Dag) -> tuple[list[Vertex], list[Edge]]:
    rewards, edges = dag.rewards, dag.edges
    vertices = [(dag.form(node), rewards.visits[node], rewards.mean(node)) for node in range(len(dag))]
    return vertices, list(zip(edges.parent, edges.child, edges.production, strict=True))[1:]


def _of_blocks(dag: BlockDag) -> tuple[list[Vertex], list[Edge]]:
    nodes = tuple(dag.nodes.values())
    numbers = {node: number for number, node in enumerate(nodes)}
    vertices = [(node.form, node.visits, node.mean if node.visits else 0.0) for node in nodes]
    edges = [
        (numbers[node], numbers[child], production) for node in nodes for production, child, _ in node.children or ()
    ]
    return vertices, edges
