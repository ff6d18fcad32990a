"""The command `grammarbt`: its verbs, its global options, its exit codes."""

from __future__ import annotations

import importlib
import os
import sys
import traceback
from typing import TYPE_CHECKING

import click

from grammarbt import __version__
from grammarbt.cli.failures import INTERRUPTED, SUCCESS, drop_output, report
from grammarbt.errors import UnknownNameError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from grammarbt.plugins import Registry

# Verb: where its command is, and its line in --help, which therefore imports none of them.
VERBS: Mapping[str, tuple[str, str]] = {
    "run": ("grammarbt.cli.run:command", "Learn a tree: any searcher, any grammar, any domain."),
    "resume": ("grammarbt.cli.resume:command", "Go on with a run, or give it a larger budget."),
    "evaluate": ("grammarbt.cli.evaluate:command", "Measure a tree on fresh scenarios."),
    "bench": ("grammarbt.cli.bench:command", "Searchers × domains × seeds at equal budget."),
    "compare": ("grammarbt.cli.compare:command", "Put finished runs side by side."),
    "report": ("grammarbt.cli.report:command", "Write a page about a run, or about several."),
    "replay": ("grammarbt.cli.replay:command", "Play an episode: the world beside the tree."),
    "watch": ("grammarbt.cli.watch:command", "Follow a run of another process or machine."),
    "tree": ("grammarbt.cli.tree:command", "Show, convert, check or simplify a tree."),
    "grammar": ("grammarbt.cli.grammar:command", "Check a grammar, count and sample its trees, read trees back."),
    "check": ("grammarbt.cli.check:command", "Put a domain or a searcher to the conformance kit."),
    "new": ("grammarbt.cli.new:command", "Write a working plugin to edit."),
    "plugins": ("grammarbt.cli.plugins:command", "List plugins, or the parameters of one component."),
}
_FLAGS = ("--traceback", "--strict-plugins")
_NAMING = "--no-plugin"


class Verbs(click.Group):
    """The verbs, each imported when it is used."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        """The verbs in the order of the table."""
        return list(VERBS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import the verb's command; a name nobody knows is an `UnknownNameError`."""
        if cmd_name.startswith("-"):
            return super().get_command(ctx, cmd_name)
        if cmd_name not in VERBS:
            raise UnknownNameError("command", cmd_name, VERBS)
        module, _, attribute = VERBS[cmd_name][0].partition(":")
        command: click.Command = getattr(importlib.import_module(module), attribute)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write the verbs' lines from the table."""
        with formatter.section("Commands"):
            formatter.write_dl([(verb, text) for verb, (_, text) in VERBS.items()])


@click.group(
    cls=Verbs, invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]}, name="grammarbt"
)
@click.version_option(__version__, message="%(prog)s %(version)s")
@click.option("--traceback", "_traceback", is_flag=True, help="Show where an error comes from.")
@click.option(_NAMING, multiple=True, metavar="NAME", help="Do not load this plugin, or `all`; repeatable.")
@click.option("--strict-plugins", is_flag=True, help="A plugin that cannot be loaded is an error.")
@click.pass_context
def application(context: click.Context, _traceback: bool, no_plugin: tuple[str, ...], strict_plugins: bool) -> None:
    """Learn behavior trees from a grammar.

    These options may stand anywhere on the line.
    """
    context.obj = (no_plugin, strict_plugins)
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


def open_registry() -> Registry:
    """The components that the user's options and environment allow; loads the plugins, for verbs that need them."""
    from grammarbt.cli.output import warn  # noqa: PLC0415 - `--help` needs no plugin
    from grammarbt.plugins import PluginHost, PluginOptions, Registry  # noqa: PLC0415

    no_plugin, strict = click.get_current_context().obj
    environment = PluginOptions.from_environment(os.environ)
    options = PluginOptions(environment.disabled + no_plugin, environment.strict or strict)
    return Registry(PluginHost(options, warn))


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and give its exit code: 0, 2 for a user's mistake, 130 after Ctrl-C, 1 for a bug."""
    line = sys.argv[1:] if arguments is None else arguments
    try:
        answer = application.main(_global_options_first(line), prog_name="grammarbt", standalone_mode=False)
        sys.stdout.flush()
    except (KeyboardInterrupt, click.Abort):
        return INTERRUPTED
    except BrokenPipeError:
        drop_output()  # whoever read the output has seen enough
        return SUCCESS
    except Exception as error:  # noqa: BLE001 - the last border: a user never sees a traceback unasked
        if "--traceback" in line:
            traceback.print_exc()
        return report(error)
    return answer if isinstance(answer, int) else SUCCESS


def _global_options_first(arguments: Sequence[str]) -> list[str]:
    """Click wants the group's options before the verb; people write them anywhere."""
    front: list[str] = []
    rest: list[str] = []
    words = iter(arguments)
    for word in words:
        if word == "--":
            rest += [word, *words]
        elif word == _NAMING:
            name = next(words, None)
            if name is None:
                raise click.UsageError(f"option {_NAMING!r} needs the name of a plugin")
            front += [word, name]
        else:
            (front if word in _FLAGS or word.startswith(f"{_NAMING}=") else rest).append(word)
    return front + rest
