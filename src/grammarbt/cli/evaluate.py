"""`grammarbt evaluate`: measure a tree on fresh scenarios."""

from __future__ import annotations

import attrs
import click

from grammarbt.cli.app import open_registry
from grammarbt.cli.options import domain_settings, json_option, worlds_option
from grammarbt.cli.output import emit_json, table
from grammarbt.run.ablate import Ablator, Functional
from grammarbt.run.score import Score, Validator
from grammarbt.run.spec import RunSpec, settings_of
from grammarbt.run.trees import load_tree


@click.command("evaluate")
@click.argument("tree")
@click.option("--domain", metavar="NAME|FILE.py:NAME", help="The simulator; marine unless given.")
@domain_settings
@click.option("--episodes", "validation", type=int, metavar="N", help="Fresh worlds; 2000 unless given.")
@worlds_option
@click.option("--functional", is_flag=True, help="Take out each sub-tree of the root, and say which ones work.")
@json_option
def command(tree: str, settings: tuple[str, ...], functional: bool, as_json: bool, **options: object) -> None:
    """Measure TREE: notation, a file, or a run folder.

    The worlds are those that a run of the same seed validates on, never those it searches on.
    """
    spec = RunSpec().overridden(options, settings_of(settings, ("domain",)))
    registry = open_registry()
    validator = Validator(registry.make_domain(spec.domain, spec.settings("domain")), spec.seed)
    found = load_tree(tree, registry)
    score = validator.score(found, spec.validation)
    parts = Ablator(validator, spec.validation).ablate(found) if functional else None
    if as_json:
        emit_json(attrs.asdict(score) | (attrs.asdict(parts) if parts else {}))
    else:
        print(_summary(score, parts))


def _summary(score: Score, parts: Functional | None) -> str:
    first = f"{score.mean:.5g} ± {score.stderr:.2g} on {score.episodes:,} fresh worlds"
    if parts is None:
        return first
    rows = [
        (f"{part.drop:+.4g}", f"± {part.stderr:.2g}", part.group or "-", "works" if part.works else "", part.subtree)
        for part in parts.functional
    ]
    verdict = {True: "complete", False: "not complete", None: "no reference to compare with"}[parts.complete]
    return "\n".join([first, table([("LOST", "", "GROUP", "", "WITHOUT"), *rows]), verdict])
