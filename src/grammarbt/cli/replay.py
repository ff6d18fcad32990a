"""`grammarbt replay`: watch an episode."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal, cast, get_args

import click
from attrs import frozen

from grammarbt.bt import BehaviorTree, compile_policy, format_tree
from grammarbt.cli.app import open_registry
from grammarbt.cli.options import domain_settings
from grammarbt.domain import Domain
from grammarbt.errors import FormatError, RunError
from grammarbt.report import btlog
from grammarbt.report.entrants import domain_of
from grammarbt.report.history import read_history
from grammarbt.report.recording import watch
from grammarbt.report.replay import replay_page
from grammarbt.run.spec import RunSpec, settings_of
from grammarbt.run.trees import load_tree

if TYPE_CHECKING:
    from collections.abc import Mapping

    from grammarbt.domain import Episode
    from grammarbt.plugins import Registry

Format = Literal["html", "gif", "png", "pdf", "btlog"]
_FORMATS = get_args(Format)
_MOST_LETTERS = 80
"""Of a tree in a title."""


@click.command("replay")
@click.argument("tree", metavar="RUN|TREE")
@click.option("--domain", metavar="NAME|FILE.py:NAME", help="The simulator; the run's own, or marine, unless given.")
@domain_settings
@click.option("--seed", type=int, metavar="N", help="Which fresh worlds; the run's own, or 0, unless given.")
@click.option("--scenario", type=click.IntRange(min=0), default=0, metavar="N", help="Which of them; 0 unless given.")
@click.option("--tick", type=click.IntRange(min=0), metavar="N", help="Of a still picture; the last unless given.")
@click.option("--format", "name", metavar="FORMAT", help="html, gif, png, pdf or btlog; as the file ends unless given.")
@click.option(
    "-o", "--output", type=click.Path(path_type=Path),
    help="The file; replay.FORMAT in the run's folder, or here, unless given.",
)  # fmt: skip
def command(
    tree: str, settings: tuple[str, ...], name: str | None, output: Path | None, **options: int | str | None
) -> None:
    """Play an episode of TREE: notation, a file, or a run folder, whose domain and parameters are then used.

    A page shows the world beside the tree; a btlog is for Groot2.
    """
    form = _format(name, output)
    scenario, tick = cast("int", options.pop("scenario")), cast("int | None", options.pop("tick"))
    show = _show(tree, options, settings_of(settings, ("domain",)).get("domain", {}), open_registry())
    path = output or show.folder / f"replay.{form}"
    policy = compile_policy(show.tree, show.domain.vocabulary.index)
    _save(show, watch(show.domain, show.name, policy, show.seed, scenario), form, path, tick)
    print(path)


@frozen(eq=False)
class _Show:
    """What plays: the tree, in the worlds of a domain and a seed; and where pages about it go."""

    tree: BehaviorTree
    domain: Domain
    name: str
    seed: int
    folder: Path


def _show(
    text: str, options: Mapping[str, int | str | None], settings: Mapping[str, object], registry: Registry
) -> _Show:
    tree = load_tree(text, registry)
    spec = RunSpec().overridden(options, {"domain": dict(settings)})
    if not _is_run(text):
        return _Show(tree, registry.make_domain(spec.domain, settings), spec.domain, spec.seed, Path())
    history = read_history(Path(text))
    seed = spec.seed if options["seed"] is not None else history.seed
    if options["domain"] is None and not settings:
        return _Show(tree, domain_of(history, registry), history.domain, seed, history.folder)
    return _Show(tree, registry.make_domain(spec.domain, settings), spec.domain, seed, history.folder)


def _is_run(text: str) -> bool:
    try:
        return Path(text).is_dir()
    except (OSError, ValueError):  # notation may be longer than a name can be
        return False


def _save(show: _Show, episode: Episode, form: Format, path: Path, tick: int | None) -> None:
    if form == "html":
        path.write_text(replay_page(_title(show), show.tree, episode), encoding="utf-8")
    elif form == "btlog":
        path.write_bytes(btlog.dumps(show.tree, episode))
    else:
        _save_picture(show, episode, path, tick)


def _save_picture(show: _Show, episode: Episode, path: Path, tick: int | None) -> None:
    from grammarbt.report.animation import save_gif, save_still  # noqa: PLC0415 - imports an extra

    last = len(episode.frames)
    if tick is not None and tick > last:
        raise RunError(f"the episode has no tick {tick}", f"choose one from 0 to {last}")
    if path.suffix == ".gif":
        save_gif(show.tree, episode, path)
    else:
        save_still(show.tree, episode, last if tick is None else tick, path)


def _title(show: _Show) -> str:
    text = format_tree(show.tree)
    return f"{show.name}: {text if len(text) <= _MOST_LETTERS else text[: _MOST_LETTERS - 1] + '…'}"


def _format(name: str | None, output: Path | None) -> Format:
    form = name or (output.suffix.removeprefix(".") if output else "") or "html"
    if form not in _FORMATS:
        raise FormatError(f"an episode cannot be written as {form!r}", f"choose one of {', '.join(_FORMATS)}")
    return cast("Format", form)
