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
    """The grammar that the domain is searched with, and that of the published search space."""
    return [
        GrammarSpec(
            name="pickplace",
            package="grammarbt_pickplace",
            resource="pickplace.grammar",
            help="Plans of actions and goals until the task is done; each action has one place in the tree.",
        ),
        GrammarSpec(
            name="pickplace-published",
            package="grammarbt_pickplace",
            resource="published.grammar",
            help="The published space: fallbacks and sequences in turn, none of them ending with a condition.",
        ),
    ]
