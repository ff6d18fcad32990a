"""`grammarbt tree`: look at trees, translate them, compare them."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, cast

import click

from grammarbt.bt import BehaviorTree, Condition, format_tree
from grammarbt.cli import tree_check
from grammarbt.cli.app import open_registry
from grammarbt.cli.drawing import drawing
from grammarbt.cli.failures import SUCCESS
from grammarbt.cli.output import emit_json
from grammarbt.errors import FormatError
from grammarbt.plugins.resolve import load
from grammarbt.run.trees import load_tree

if TYPE_CHECKING:
    from grammarbt.plugins import Registry

DIFFERENT = 1
"""Exit status of `tree diff` when the trees differ."""

_domain = click.option(
    "--domain",
    metavar="NAME|FILE.py:NAME",
    help="Say by its declarations which conditions are pure; all, if not given.",
)
_as_json = click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")


@click.group("tree", context_settings={"help_option_names": ["-h", "--help"]})
def command() -> None:
    """Look at trees, translate them, compare them.

    A TREE is notation, a file in any format that can be read, or a run folder.
    """


command.add_command(tree_check.command)


@command.command("show")
@click.argument("tree")
def show(tree: str) -> None:
    """Draw TREE, a node a line."""
    print("\n".join(drawing(load_tree(tree, open_registry()))))


@command.command("convert")
@click.argument("tree")
@click.option("--to", "name", required=True, metavar="FORMAT", help="notation, tree, btcpp, py_trees, dot, svg, …")
@click.option("-o", "--output", type=click.Path(path_type=Path), help="Write to a file instead of the terminal.")
def convert(tree: str, name: str, output: Path | None) -> None:
    """Write TREE in another format."""
    registry = open_registry()
    spec = registry.format(name)
    if spec.exporter is None:
        raise FormatError(
            f"format {name!r} can only be read", "choose another one; `grammarbt plugins core` lists them"
        )
    dumps = cast("Callable[[BehaviorTree], str | bytes]", load(spec.exporter, f"format {name!r}"))
    _write(dumps(load_tree(tree, registry)), output)


@command.command("simplify")
@click.argument("tree")
@_domain
def simplify(tree: str, domain: str | None) -> None:
    """Print the smallest tree found that behaves like TREE, proven equal."""
    from grammarbt.bt.simplify import simplify as simplified  # noqa: PLC0415  only this verb needs it

    registry = open_registry()
    print(format_tree(simplified(load_tree(tree, registry), _purity(domain, registry))))


@command.command("diff")
@click.argument("one")
@click.argument("other")
@_domain
@_as_json
def diff(one: str, other: str, domain: str | None, as_json: bool) -> int:
    """Say whether ONE and OTHER always behave alike; exit with 1 and a shortest difference if not."""
    from grammarbt.bt.compare import difference  # noqa: PLC0415  only this verb needs it

    registry = open_registry()
    found = difference(load_tree(one, registry), load_tree(other, registry), _purity(domain, registry))
    answers = [(answer.leaf, answer.status.name.lower()) for answer in found.answers] if found else []
    if as_json:
        sides = {"one": found.one, "other": found.other} if found else {}
        emit_json({"equal": found is None, "answers": answers, **sides})
    elif found is None:
        print("equal")
    else:
        lines = [f"{leaf} answers {status}" for leaf, status in answers]
        print("\n".join([*lines, f"then the first tree {found.one}", f"and the second {found.other}"]))
    return SUCCESS if found is None else DIFFERENT


def _purity(domain: str | None, registry: Registry) -> Callable[[Condition], bool]:
    if domain is None:
        return lambda _: True
    return registry.make_domain(domain, {}).vocabulary.is_pure


def _write(result: str | bytes, output: Path | None) -> None:
    data = result if isinstance(result, bytes) else (result.rstrip("\n") + "\n").encode()
    if output is not None:
        output.write_bytes(data)
        return
    sys.stdout.flush()
    sys.stdout.buffer.write(data)
