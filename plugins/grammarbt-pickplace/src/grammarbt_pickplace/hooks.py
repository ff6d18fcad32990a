"""What this plugin announces; light, so that listing components imports no simulator."""

from __future__ import annotations

from grammarbt.plugins import DomainSpec, GrammarSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_domains() -> list[DomainSpec]:
    """The pick and place domain."""
    return [
        DomainSpec(
            name="pickplace",
            factory="grammarbt_pickplace.domain:PickPlace",
            parameters="grammarbt_pickplace.parameters:PickPlaceParameters",
            help="Pick and place with a mobile manipulator: fetch one or three cubes (Iovino et al., ICRA 2021).",
        )
    ]


@hookimpl
def grammarbt_grammars() -> list[GrammarSpec]:
    """The grammar of the published search space."""
    return [
        GrammarSpec(
            name="pickplace",
            package="grammarbt_pickplace",
            resource="pickplace.grammar",
            help="Fallbacks and sequences in turn, over all leaves, none of them ending with a condition.",
        )
    ]
