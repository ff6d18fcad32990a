"""A plugin as grammarbt sees it: who brings it, what it provides, or why it is out of use."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Literal, TypeAlias

from attrs import evolve, frozen

from grammarbt.plugins.specs import DomainSpec, ExecutorSpec, FormatSpec, GrammarSpec, SearcherSpec

Spec: TypeAlias = SearcherSpec | DomainSpec | GrammarSpec | ExecutorSpec | FormatSpec
Components: TypeAlias = Mapping[str, tuple[Spec, ...]]

CORE = "core"
"""The name under which grammarbt lists its own components."""

SPEC_TYPES: Mapping[str, type[Spec]] = MappingProxyType(
    {
        "searchers": SearcherSpec,
        "domains": DomainSpec,
        "grammars": GrammarSpec,
        "executors": ExecutorSpec,
        "formats": FormatSpec,
    }
)
"""The kinds of components, each with the class that describes one."""

NOTHING: Components = MappingProxyType(dict.fromkeys(SPEC_TYPES, ()))


@frozen(eq=False)
class Plugin:
    """A plugin and what became of it.

    Attributes:
        name: its entry point's name.
        distribution: the distribution that brings it.
        version: the distribution's version.
        status: `"set aside"` when something is wrong with it.
        error: what is wrong with it, one line.
        provides: its components by kind; all empty unless the status is `"ok"`.
    """

    name: str
    distribution: str
    version: str
    status: Literal["ok", "disabled", "set aside"] = "ok"
    error: str = ""
    provides: Components = NOTHING

    def __str__(self) -> str:
        return f"plugin {self.name!r} of {self.distribution} {self.version}"

    def set_aside(self, reason: str) -> Plugin:
        """The same plugin, out of use."""
        return evolve(self, status="set aside", error=" ".join(reason.split()), provides=NOTHING)


def without_clashes(plugins: Sequence[Plugin]) -> tuple[Plugin, ...]:
    """The same plugins, those that claim a component's name together set aside; the core's own names stay with it.

    All of them, so that nothing depends on who is found first.
    """
    claims: dict[tuple[str, str], list[Plugin]] = defaultdict(list)
    for plugin in plugins:
        for kind, specs in plugin.provides.items():
            for spec in specs:
                claims[kind, spec.name].append(plugin)
    clashes = {key: claimants for key, claimants in claims.items() if len(claimants) > 1}
    return tuple(_without_clash(plugin, clashes) for plugin in plugins)


def _without_clash(plugin: Plugin, clashes: Mapping[tuple[str, str], Sequence[Plugin]]) -> Plugin:
    for (kind, name), claimants in clashes.items():
        if plugin in claimants and plugin.name != CORE:
            others = " and ".join(str(other) for other in claimants if other is not plugin)
            return plugin.set_aside(f"{kind.removesuffix('s')} {name!r} is also claimed by {others}")
    return plugin
