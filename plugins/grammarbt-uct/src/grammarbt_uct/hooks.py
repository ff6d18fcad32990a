"""What this plugin brings; imports no searcher."""

from __future__ import annotations

from grammarbt.plugins import SearcherSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_searchers() -> tuple[SearcherSpec, ...]:
    """The one searcher."""
    return (
        SearcherSpec(
            name="uct",
            factory="grammarbt_uct.search:Uct",
            parameters="grammarbt_uct.parameters:UctParameters",
            help="UCT over leftmost derivations (Kocsis & Szepesvári 2006).",
        ),
    )
