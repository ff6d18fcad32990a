"""What this plugin brings; imports no searcher."""

from __future__ import annotations

from grammarbt.plugins import GrammarSpec, SearcherSpec, hookimpl

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


@hookimpl
def grammarbt_grammars() -> tuple[GrammarSpec, ...]:
    """Variants of the marine grammar, to see what a part of it is worth; they fit any domain with groups."""
    helps = {
        "ungrouped": "Without groups: sub-trees with the marine grammar's structure, but with leaves of any group.",
        "unstructured": "Without structure: a sub-tree per group, with control nodes and leaves in any order.",
        "defaulted": "With a default sub-tree: the marine grammar, and one action without conditions at the end.",
    }
    return tuple(GrammarSpec(name, "grammarbt_dagmcts", f"{name}.grammar", text) for name, text in helps.items())
