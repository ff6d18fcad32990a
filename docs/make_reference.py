"""Write the pages of docs/reference that follow from the code: python docs/make_reference.py.

A test compares what this gives with what stands there.
"""

from __future__ import annotations

import ast
import importlib
import inspect
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import click

from grammarbt import errors
from grammarbt.cli.app import VERBS, application
from grammarbt.plugins import PluginHost, PluginOptions, Registry, hookspecs, specs
from grammarbt.plugins.parameters import Parameter, describe

PUBLIC = (
    "grammarbt.bt",
    "grammarbt.bt.formats.btcpp",
    "grammarbt.domain",
    "grammarbt.domain.chance",
    "grammarbt.domain.plain",
    "grammarbt.domain.playthrough",
    "grammarbt.domain.sources",
    "grammarbt.grammar",
    "grammarbt.plugins",
    "grammarbt.plugins.events",
    "grammarbt.search",
    "grammarbt.testing",
)
"""The modules whose `__all__` others may rely on."""

KINDS = ("searchers", "domains", "executors", "grammars", "formats")
REFERENCE = Path(__file__).parent / "reference"
EVENTS = "grammarbt.plugins.events"


def pages() -> dict[str, str]:
    """Every generated page, by file name."""
    return {
        "cli.md": _page("The command line", _cli()),
        "hooks.md": _page("Hooks", _hooks()),
        "components.md": _page("Components and their parameters", _components()),
        "api.md": _page("Public names", _api()),
    }


def _page(title: str, lines: Iterator[str]) -> str:
    text = "\n".join([f"# {title}", "", *lines])
    return text.rstrip() + "\n"


def _cli() -> Iterator[str]:
    yield "Exit codes: 0 on success, 2 after a user's mistake, 130 after Ctrl-C, 1 where a verb answers *no*."
    yield ""
    group = click.Context(application, info_name="grammarbt", **application.context_settings)
    for verb in VERBS:
        command = application.get_command(group, verb)
        if command is not None:
            yield from _command(command, click.Context(command, parent=group, info_name=verb))


def _command(command: click.Command, context: click.Context) -> Iterator[str]:
    if isinstance(command, click.Group):
        for name in command.list_commands(context):
            below = command.get_command(context, name)
            if below is not None:
                yield from _command(below, click.Context(below, parent=context, info_name=name))
        return
    yield f"## `{context.command_path}`"
    yield ""
    yield "```text"
    context.max_content_width = 100
    yield from (line.rstrip() for line in command.get_help(context).splitlines())
    yield "```"
    yield ""


def _hooks() -> Iterator[str]:
    yield "A plugin's `hooks` module implements what it needs of these; the entry-point group is `grammarbt`."
    yield f"The present number of the interface, `GRAMMARBT_API`, is {specs.GRAMMARBT_API}."
    yield ""
    named = [(name, hook) for name, hook in vars(hookspecs).items() if name.startswith("grammarbt_")]
    for name, hook in named:
        yield f"## `{name}`"
        yield ""
        signature = str(inspect.signature(hook)).replace("'", "")  # annotations are kept as texts
        yield f"```python\ndef {name}{signature}: ...\n```"
        yield ""
        yield inspect.getdoc(hook) or ""
        yield ""
    yield "## Descriptions and events"
    yield ""
    events = importlib.import_module(EVENTS)
    for module in (specs, events):
        for name, thing in vars(module).items():
            if inspect.isclass(thing) and thing.__module__ == module.__name__:
                yield f"### `{name}`"
                yield ""
                yield f"```text\n{inspect.getdoc(thing)}\n```"
                yield ""


def _components() -> Iterator[str]:
    yield "What the core and the plugins of this repository bring. `grammarbt plugins NAME` prints the same."
    yield ""
    registry = Registry(PluginHost(PluginOptions(), lambda _: None))
    for kind in KINDS:
        yield f"## {kind.capitalize()}"
        yield ""
        found = [(spec, plugin) for plugin in registry.host.plugins for spec in plugin.provides[kind]]
        for spec, plugin in sorted(found, key=lambda pair: pair[0].name):
            yield f"### `{spec.name}`"
            yield ""
            yield f"{spec.help or '–'} *{plugin.distribution}*"
            yield ""
            if isinstance(spec, specs.SearcherSpec | specs.DomainSpec | specs.ExecutorSpec):
                yield from _parameters(kind.removesuffix("s"), describe(registry.parameters_of(spec)))


def _parameters(part: str, parameters: tuple[Parameter, ...]) -> Iterator[str]:
    if not parameters:
        return
    yield "| parameter | takes | default | |"
    yield "| --- | --- | --- | --- |"
    for each in parameters:
        default = "required" if each.required else f"`{each.default}`"
        takes = str(each.type).replace("|", "\\|")
        yield f"| `{part}.{each.name}` | {takes} | {default} | {each.help} |"
    yield ""


def _api() -> Iterator[str]:
    yield "These names are stable: a release that removes or changes one says so a minor version before, with a"
    yield "`DeprecationWarning` that names the replacement. Everything else is the project's own."
    yield ""
    for path in PUBLIC:
        module = importlib.import_module(path)
        yield f"## `{path}`"
        yield ""
        yield (inspect.getdoc(module) or "").splitlines()[0]
        yield ""
        for name in sorted(module.__all__):
            yield f"- `{name}`{_summary(path, name, getattr(module, name))}"
        yield ""
    yield "## `grammarbt.errors`"
    yield ""
    yield "Every error of the project is a `GrammarBTError`, with a `message` and a `hint`."
    yield ""
    for name, thing in vars(errors).items():
        if inspect.isclass(thing) and thing.__module__ == errors.__name__:
            yield f"- `{name}`{_summary(errors.__name__, name, thing)}"
    yield ""


def _summary(module: str, name: str, thing: object) -> str:
    """The first line of what the code says about a public name of a module."""
    own = inspect.isclass(thing) or inspect.isroutine(thing) or hasattr(thing, "__wrapped__")
    text = (inspect.getdoc(thing) if own else _below_assignment(module, name)) or ""
    return f": {text.strip().splitlines()[0]}" if text.strip() else ""


def _below_assignment(module: str, name: str) -> str | None:
    """What stands below a constant or an alias, in the module where it is made."""
    body = ast.parse(inspect.getsource(importlib.import_module(module))).body
    for statement, below in pairwise([*body, ast.Pass()]):
        if isinstance(statement, ast.ImportFrom) and statement.module and name in _names(statement):
            return _below_assignment(statement.module, name)
        if name in _names(statement) and isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant):
            return str(below.value.value)
    return None


def _names(statement: ast.stmt) -> list[str]:
    """The names that a statement brings in or assigns."""
    if isinstance(statement, ast.ImportFrom):
        return [alias.name for alias in statement.names]
    targets = statement.targets if isinstance(statement, ast.Assign) else [getattr(statement, "target", None)]
    return [target.id for target in targets if isinstance(target, ast.Name)]


if __name__ == "__main__":
    for name, text in pages().items():
        (REFERENCE / name).write_text(text, encoding="utf-8")
