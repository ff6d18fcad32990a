"""Plugins: what they announce, and the host that loads them."""

from grammarbt.plugins.hookspecs import hookimpl
from grammarbt.plugins.host import PluginHost, PluginOptions
from grammarbt.plugins.registry import Registry
from grammarbt.plugins.specs import (
    GRAMMARBT_API,
    DomainSpec,
    ExecutorSpec,
    FormatSpec,
    GrammarSpec,
    SearcherSpec,
)

__all__ = [
    "GRAMMARBT_API",
    "DomainSpec",
    "ExecutorSpec",
    "FormatSpec",
    "GrammarSpec",
    "PluginHost",
    "PluginOptions",
    "Registry",
    "SearcherSpec",
    "hookimpl",
]
