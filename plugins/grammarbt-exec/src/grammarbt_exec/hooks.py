"""What this plugin announces; light, and it starts no program."""

from __future__ import annotations

from grammarbt.plugins import DomainSpec, hookimpl

GRAMMARBT_API = 1


@hookimpl
def grammarbt_domains() -> list[DomainSpec]:
    """The domain that is any program."""
    return [
        DomainSpec(
            name="exec",
            factory="grammarbt_exec.domain:make_exec",
            parameters="grammarbt_exec.parameters:ExecParameters",
            help="Any program, in any language, that speaks JSON lines on its standard input and output.",
        )
    ]
