"""What this plugin announces; light, so that listing components imports no simulator."""

from __future__ import annotations

from grammarbt.plugins import DomainSpec, GrammarSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_domains() -> list[DomainSpec]:
    """Every environment with discrete actions, chosen by a parameter."""
    return [
        DomainSpec(
            name="gymnasium",
            factory="grammarbt_gymnasium.domain:GymnasiumDomain",
            parameters="grammarbt_gymnasium.parameters:GymnasiumParameters",
            help="Any Gymnasium environment with discrete actions; conditions compare observations with thresholds.",
        ),
    ]


@hookimpl
def grammarbt_grammars() -> list[GrammarSpec]:
    """The default grammar."""
    return [
        GrammarSpec(
            name="gymnasium",
            package="grammarbt_gymnasium",
            resource="gymnasium.grammar",
            help="A fallback over actions guarded by one or two conditions, with an unguarded action at the end.",
        ),
    ]
