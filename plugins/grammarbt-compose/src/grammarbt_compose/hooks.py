"""What this plugin brings; imports no searcher."""

from __future__ import annotations

from grammarbt.plugins import SearcherSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_searchers() -> tuple[SearcherSpec, ...]:
    """The one searcher."""
    return (
        SearcherSpec(
            name="compose",
            factory="grammarbt_compose.search:Compose",
            parameters="grammarbt_compose.parameters:ComposeParameters",
            help="Composes trees from sub-trees of the groups, short ones first; every change races the present tree.",
        ),
    )
