"""What this plugin brings; imports no searcher."""

from __future__ import annotations

from grammarbt.plugins import SearcherSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_searchers() -> tuple[SearcherSpec, ...]:
    """The one searcher, with its two mappings."""
    return (
        SearcherSpec(
            name="ge",
            factory="grammarbt_ge.search:GrammaticalEvolution",
            parameters="grammarbt_ge.parameters:GeParameters",
            help="Grammatical evolution: lists of codons choose productions (O'Neill & Ryan 2001).",
        ),
    )
