"""What this plugin brings; imports no searcher."""

from __future__ import annotations

from grammarbt.plugins import SearcherSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_searchers() -> tuple[SearcherSpec, ...]:
    """The one searcher."""
    return (
        SearcherSpec(
            name="qlearning",
            factory="grammarbt_qlearning.search:QLearning",
            parameters="grammarbt_qlearning.parameters:QLearningParameters",
            help="Q-learning over the productions of the grammar (Dey & Child 2013; Watkins 1989).",
        ),
    )
