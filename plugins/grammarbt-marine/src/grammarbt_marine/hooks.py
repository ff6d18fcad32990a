"""What this plugin announces; light, so that listing components imports no simulator."""

from __future__ import annotations

from grammarbt.plugins import DomainSpec, GrammarSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_domains() -> list[DomainSpec]:
    """The marine domain."""
    return [
        DomainSpec(
            name="marine",
            factory="grammarbt_marine.domain:Marine",
            parameters="grammarbt_marine.parameters:MarineParameters",
            help="Marine target search and response: locate and report targets, disarm mines, retrieve objects.",
        )
    ]


@hookimpl
def grammarbt_grammars() -> list[GrammarSpec]:
    """The grammar that spans one sub-tree per group of leaves."""
    return [
        GrammarSpec(
            name="marine",
            package="grammarbt_marine",
            resource="marine.grammar",
            help="A fallback over one sub-tree per group; each sub-tree a sequence without repeated leaves.",
        )
    ]
