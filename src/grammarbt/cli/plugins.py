"""`grammarbt plugins`: what is installed, what is wrong with it, and the parameters of a component."""

from __future__ import annotations

from typing import TYPE_CHECKING

import attrs
import click

from grammarbt.cli.app import open_registry
from grammarbt.cli.options import json_option
from grammarbt.cli.output import emit_json, table
from grammarbt.errors import UnknownNameError
from grammarbt.plugins.parameters import Parameter, describe
from grammarbt.plugins.plugin import Plugin, Spec
from grammarbt.plugins.specs import FormatSpec, GrammarSpec

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grammarbt.plugins import Registry


@attrs.frozen
class Component:
    """One component with its parameters, for people."""

    kind: str
    name: str
    help: str
    parameters: tuple[Parameter, ...]


@click.command("plugins")
@click.argument("name", required=False)
@json_option
def command(name: str | None, as_json: bool) -> None:
    """List the plugins, or show the components that NAME stands for.

    NAME is a plugin or a component; its parameters are what --set takes.
    """
    registry = open_registry()
    plugins = registry.host.plugins if name is None else _about(registry, name)
    components = [] if name is None else _components(registry, plugins, name)
    if as_json:
        listing: dict[str, object] = {"plugins": [_as_json(plugin) for plugin in plugins]}
        shown = {"components": [attrs.asdict(component) for component in components]}
        emit_json(listing if name is None else listing | shown)
    else:
        print(_listing(plugins))
        for component in components:
            print(f"\n{_page(component)}")


def _about(registry: Registry, name: str) -> list[Plugin]:
    """The plugins called so or bringing a component called so."""
    found = [plugin for plugin in registry.host.plugins if name in {plugin.name, *_component_names(plugin)}]
    if not found:
        known = {known for plugin in registry.host.plugins for known in (plugin.name, *_component_names(plugin))}
        raise UnknownNameError("plugin or component", name, known)
    return found


def _component_names(plugin: Plugin) -> list[str]:
    return [spec.name for specs in plugin.provides.values() for spec in specs]


def _components(registry: Registry, plugins: Sequence[Plugin], name: str) -> list[Component]:
    """The components called `name`, or everything that the plugin of that name brings."""
    return [
        Component(kind.removesuffix("s"), spec.name, spec.help, _parameters(registry, spec))
        for plugin in plugins
        for kind, specs in plugin.provides.items()
        for spec in specs
        if name in {spec.name, plugin.name}
    ]


def _parameters(registry: Registry, spec: Spec) -> tuple[Parameter, ...]:
    return () if isinstance(spec, GrammarSpec | FormatSpec) else describe(registry.parameters_of(spec))


def _as_json(plugin: Plugin) -> dict[str, object]:
    return {
        "name": plugin.name,
        "distribution": plugin.distribution,
        "version": plugin.version,
        "status": plugin.status,
        "error": plugin.error or None,
        "provides": {kind: [spec.name for spec in specs] for kind, specs in plugin.provides.items()},
    }


def _listing(plugins: Sequence[Plugin]) -> str:
    head = ("NAME", "DISTRIBUTION", "VERSION", "STATUS", "PROVIDES")
    return table([head, *((p.name, p.distribution, p.version, p.status, p.error or _provides(p)) for p in plugins)])


def _provides(plugin: Plugin) -> str:
    kinds = ((kind, [spec.name for spec in specs]) for kind, specs in plugin.provides.items())
    return "; ".join(f"{kind}: {', '.join(names)}" for kind, names in kinds if names)


def _page(component: Component) -> str:
    title = f"{component.kind} {component.name}: {component.help}"
    prefix = component.kind
    rows = [(f"  {prefix}.{p.name}", p.type, _default(p), p.help) for p in component.parameters]
    return "\n".join([title, table(rows)]) if rows else title


def _default(parameter: Parameter) -> str:
    if parameter.required:
        return "required"
    default = parameter.default
    return f"default {default if isinstance(default, str) else str(default).lower()}"
