"""Commands that pages mention and no test types: their verbs and options exist, and their settings do."""

import re
import shlex
from pathlib import Path

import click
import pytest

from grammarbt.cli.app import VERBS, application
from grammarbt.plugins import PluginHost, PluginOptions, Registry
from grammarbt.plugins.parameters import describe

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "benchmarks/README.md"]
PAGES += sorted(path for path in (ROOT / "docs").rglob("*.md") if "_build" not in path.parts)
COMMAND = re.compile(r"(?:^    |^\$ |`)grammarbt ([a-z][^`\n]*)", re.MULTILINE)
GLOBAL = {"--help", "--version", "--traceback", "--strict-plugins", "--no-plugin"}


def words_of(text):
    try:
        return shlex.split(text, comments=True)
    except ValueError:  # a command in a sentence may be cut off
        return text.split()


def commands(page):
    for text in COMMAND.findall(page.read_text(encoding="utf-8")):
        words = words_of(text)
        if words[0] in VERBS:
            yield words


def options_of(words):
    """The options that the command knows, also those of a verb below it."""
    context = click.Context(application)
    command = application.get_command(context, words[0])
    if isinstance(command, click.Group):
        named = words[1] if len(words) > 1 else ""
        below = [command.commands[named]] if named in command.commands else command.commands.values()
    else:
        below = [command]
    return {name for one in below for parameter in one.params for name in parameter.opts} | GLOBAL


@pytest.mark.parametrize("page", PAGES, ids=lambda path: str(path.relative_to(ROOT)))
def test_options_exist(page):
    unknown = [
        " ".join(words)
        for words in commands(page)
        if {word.partition("=")[0] for word in words if re.match(r"--?[a-z]", word)} - options_of(words)
    ]
    assert unknown == []


def test_settings_exist():
    registry = Registry(PluginHost(PluginOptions(), lambda _: None))
    known = {"searcher": set(), "domain": set(), "executor": set()}
    for part, names in known.items():
        for plugin in registry.host.plugins:
            for spec in plugin.provides[f"{part}s"]:
                names |= {parameter.name for parameter in describe(registry.parameters_of(spec))}
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    settings = set(re.findall(r"--set (searcher|domain|executor)\.([a-z_]+)=", text))
    assert settings
    assert [f"{part}.{name}" for part, name in sorted(settings) if name not in known[part]] == []
