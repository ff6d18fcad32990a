"""The hooks a plugin may implement.

Registration hooks are called once and return descriptions; observer hooks get one frozen event each, so that fields can
be added without breaking anyone.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import pluggy

from grammarbt.plugins.specs import DomainSpec, ExecutorSpec, FormatSpec, GrammarSpec, SearcherSpec

if TYPE_CHECKING:
    from grammarbt.plugins.events import RunFinished, RunStarted, TrialFinished

hookspec = pluggy.HookspecMarker("grammarbt")
hookimpl = pluggy.HookimplMarker("grammarbt")
"""Marks a function of a plugin's `hooks` module as one that implements the hook of that name."""


@hookspec
def grammarbt_searchers() -> Sequence[SearcherSpec]:  # type: ignore[empty-body]
    """The searchers this plugin brings."""


@hookspec
def grammarbt_domains() -> Sequence[DomainSpec]:  # type: ignore[empty-body]
    """The domains this plugin brings."""


@hookspec
def grammarbt_grammars() -> Sequence[GrammarSpec]:  # type: ignore[empty-body]
    """The grammars this plugin brings."""


@hookspec
def grammarbt_executors() -> Sequence[ExecutorSpec]:  # type: ignore[empty-body]
    """The executors this plugin brings."""


@hookspec
def grammarbt_formats() -> Sequence[FormatSpec]:  # type: ignore[empty-body]
    """The tree formats this plugin brings."""


@hookspec
def grammarbt_run_started(event: RunStarted) -> None:
    """A run begins, or goes on."""


@hookspec
def grammarbt_trial_finished(event: TrialFinished) -> None:
    """A trial was evaluated and journalled."""


@hookspec
def grammarbt_run_finished(event: RunFinished) -> None:
    """A run ended, for whatever reason."""
