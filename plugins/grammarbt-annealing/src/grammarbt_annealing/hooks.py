"""What this plugin brings; imports no searcher."""

from __future__ import annotations

from grammarbt.plugins import SearcherSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_searchers() -> tuple[SearcherSpec, ...]:
    """The one searcher."""
    return (
        SearcherSpec(
            name="annealing",
            factory="grammarbt_annealing.search:Annealing",
            parameters="grammarbt_annealing.parameters:AnnealingParameters",
            help="Simulated annealing over derivations (Kirkpatrick, Gelatt & Vecchi 1983).",
        ),
    )
