"""The core's own components, announced through the same hooks as everyone's."""

from __future__ import annotations

from grammarbt.plugins.builtin_formats import FORMATS
from grammarbt.plugins.hookspecs import hookimpl
from grammarbt.plugins.specs import ExecutorSpec, FormatSpec, SearcherSpec


@hookimpl
def grammarbt_searchers() -> tuple[SearcherSpec, ...]:
    """The searchers that need no plugin."""
    return (
        SearcherSpec("random", "grammarbt.search.random:RandomSearch", help="Samples words of the grammar."),
        SearcherSpec(
            "exhaustive",
            "grammarbt.search.exhaustive:ExhaustiveSearch",
            help="Simulates one tree per behaviour, smallest first, until none is left.",
        ),
    )


@hookimpl
def grammarbt_executors() -> tuple[ExecutorSpec, ...]:
    """The executors that need no plugin."""
    return (
        ExecutorSpec("serial", "grammarbt.run.executors:make_serial", help="Simulates in the run's own process."),
        ExecutorSpec(
            "processes",
            "grammarbt.run.executors:make_processes",
            "grammarbt.run.executors:ProcessParameters",
            "Simulates in worker processes, which may crash or hang without ending the run.",
        ),
    )


@hookimpl
def grammarbt_formats() -> tuple[FormatSpec, ...]:
    """The tree formats that need no plugin."""
    return FORMATS
