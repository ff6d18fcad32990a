"""What this plugin brings; imports no searcher."""

from __future__ import annotations

from grammarbt.plugins import SearcherSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_searchers() -> tuple[SearcherSpec, ...]:
    """The one searcher."""
    return (
        SearcherSpec(
            name="gp",
            factory="grammarbt_gp.search:GeneticProgramming",
            parameters="grammarbt_gp.parameters:GpParameters",
            help="Genetic programming on derivation trees, with a greedy start (Colledanchise, Parasuraman & Ögren 2019).",
        ),
    )
