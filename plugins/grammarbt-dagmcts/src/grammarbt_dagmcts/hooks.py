"""What this plugin brings; imports no searcher."""

from __future__ import annotations

from grammarbt.plugins import SearcherSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_searchers() -> tuple[SearcherSpec, ...]:
    """The one searcher, with its presets."""
    return (
        SearcherSpec(
            name="dagmcts",
            factory="grammarbt_dagmcts.search:DagMcts",
            parameters="grammarbt_dagmcts.parameters:DagMctsParameters",
            help="Monte Carlo DAG search over the grammar's derivations (Scheide, Best & Hollinger 2020).",
        ),
    )
