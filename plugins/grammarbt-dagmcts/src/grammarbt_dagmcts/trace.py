"""The DAG of a search as GraphML, for any program that draws or analyses graphs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from grammarbt.errors import SearcherError
from grammarbt.grammar import BoundGrammar, SententialForm
from grammarbt.search import Arm, BlockDag
from grammarbt_dagmcts.dag import Dag

if TYPE_CHECKING:
    import networkx as nx

Edges: TypeAlias = Iterator[tuple[SententialForm, SententialForm, int]]


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
    try:
        nx.write_graphml(graph, path)
    except OSError as error:
        raise SearcherError(
            f"cannot write {str(path)!r}: {error.strerror}", "set searcher.trace to another file"
        ) from None


def _add(graph: nx.MultiDiGraph[int], grammar: BoundGrammar, dag: Dag | BlockDag) -> None:
    first = graph.number_of_nodes()
    numbers = {form: number for number, form in enumerate(dag.nodes, first)}
    for form, arm in dag.nodes.items():
        graph.add_node(numbers[form], form=grammar.text(form), **_earned(arm))
    for parent, child, production in _edges(dag):
        graph.add_edge(numbers[parent], numbers[child], production=grammar.production_text(production))


def _earned(arm: Arm) -> dict[str, float | int]:
    return {"visits": arm.visits, "mean": arm.mean if arm.visits else 0.0}


def _edges(dag: Dag | BlockDag) -> Edges:
    if isinstance(dag, Dag):
        for node in dag.nodes.values():
            yield from ((node.form, child.form, production) for child, production in node.children.values())
    else:
        for partial in dag.nodes.values():
            yield from ((partial.form, child.form, production) for production, child, _ in partial.children or ())
