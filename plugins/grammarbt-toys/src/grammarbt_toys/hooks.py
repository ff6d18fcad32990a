"""What this plugin announces; light, so that listing components imports no simulator."""

from __future__ import annotations

from grammarbt.plugins import DomainSpec, GrammarSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_domains() -> list[DomainSpec]:
    """The toy worlds."""
    return [
        DomainSpec(
            name="taskselection",
            factory="grammarbt_toys.taskselection:TaskSelection",
            parameters="grammarbt_toys.parameters:TaskSelectionParameters",
            help="Task selection: the right action for every truth assignment of the conditions; exact, and any size.",
        ),
        DomainSpec(
            name="ant",
            factory="grammarbt_toys.ant:Ant",
            parameters="grammarbt_toys.parameters:AntParameters",
            help="The artificial ant eats along the Santa Fe trail (Koza, Genetic Programming, 1992).",
        ),
        DomainSpec(
            name="foraging",
            factory="grammarbt_toys.foraging:Foraging",
            parameters="grammarbt_toys.parameters:ForagingParameters",
            help="Swarm foraging: robots that all follow one tree bring food from sites to a hub.",
        ),
        DomainSpec(
            name="platformer",
            factory="grammarbt_toys.platformer:Platformer",
            parameters="grammarbt_toys.parameters:PlatformerParameters",
            help="A platform game: run through a level, over gaps and walls and past enemies, as far as possible.",
        ),
    ]


@hookimpl
def grammarbt_grammars() -> list[GrammarSpec]:
    """The grammars of the worlds that no shipped grammar fits."""
    return [
        GrammarSpec(
            name="taskselection",
            package="grammarbt_toys",
            resource="taskselection.grammar",
            help="A fallback over guarded actions, with an unguarded action at the end.",
        ),
        GrammarSpec(
            name="ant",
            package="grammarbt_toys",
            resource="ant.grammar",
            help="Programs of actions one after the other and of choices by a condition.",
        ),
    ]
