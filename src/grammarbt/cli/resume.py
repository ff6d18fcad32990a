"""`grammarbt resume`: go on with a run."""

from __future__ import annotations

from pathlib import Path
from typing import Any, cast

import click

from grammarbt.cli.app import open_registry
from grammarbt.cli.options import json_option, quiet_option
from grammarbt.cli.output import warn
from grammarbt.cli.progress import make_display
from grammarbt.cli.run import emit, interruptible
from grammarbt.run.folder import RunFolder
from grammarbt.run.resume import Changes, resume
from grammarbt.run.spec import settings_of


@click.command("resume")
@click.argument("run", metavar="RUN", type=click.Path(path_type=Path))
@click.option("--budget", type=int, metavar="EPISODES", help="A larger budget, in all; as before unless given.")
@click.option("--workers", type=int, metavar="N", help="Simulations side by side; as before unless given.")
@click.option("--executor", metavar="NAME", help="What simulates; as before unless given.")
@click.option("--set", "settings", multiple=True, metavar="executor.KEY=VALUE", help="Its parameters; repeatable.")
@json_option
@quiet_option
def command(run: Path, settings: tuple[str, ...], as_json: bool, quiet: bool, **options: object) -> None:
    """Go on with a run that was stopped, or give a finished one a larger budget.

    The journal ends with the same bytes as if the run had never stopped, whatever simulates.
    """
    changes = Changes(**cast("dict[str, Any]", options), settings=settings_of(settings, ("executor",)))
    registry = open_registry()
    display = make_display(registry.host, quiet=quiet)
    with interruptible(display):
        result = resume(RunFolder(run), changes, registry, display, warn)
    emit(result, as_json=as_json)
