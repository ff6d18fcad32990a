"""`grammarbt tree check`: what can never run, what was never visited, and what each sub-tree is worth."""

from __future__ import annotations

from typing import TYPE_CHECKING

import attrs
import click

from grammarbt.bt import BehaviorTree, DeadLeaf, compile_policy, dead_leaves, format_leaf, format_tree, numbered
from grammarbt.cli.app import open_registry
from grammarbt.cli.drawing import drawing, label
from grammarbt.cli.failures import SUCCESS
from grammarbt.cli.options import domain_settings, json_option, worlds_option
from grammarbt.cli.output import emit_json, table
from grammarbt.errors import ParameterError
from grammarbt.run.inspection import Inspection, NodeCount, inspect_tree
from grammarbt.run.spec import RunSpec, settings_of
from grammarbt.run.trees import load_tree

if TYPE_CHECKING:
    from grammarbt.domain import Domain

NOT_COVERED = 1
"""Exit status when fewer nodes were visited than `--coverage` asks for."""

_COUNTED = {
    "ticks": "every tick looked at",
    "leaves": "the domain counts the ticks of leaves only: a control node is visited as often as its first leaf",
}


@click.command("check")
@click.argument("tree")
@click.option("--domain", metavar="NAME|FILE.py:NAME", help="Whose leaves they are; marine unless given.")
@domain_settings
@click.option("--episodes", "validation", type=int, metavar="N", help="Watch the tree in so many fresh worlds.")
@worlds_option
@click.option("--coverage", type=float, metavar="PERCENT", help="Exit with 1 if fewer of the nodes are visited.")
@json_option
def command(
    tree: str, settings: tuple[str, ...], coverage: float | None, as_json: bool, **options: int | str | None
) -> int:
    """Tell the truth about TREE: notation, a file, or a run folder.

    Leaves that no answers lead to are found without simulating, from what the domain declares of its actions and
    conditions. With --episodes, also: which nodes were visited how often and with what result, and what changes
    when a sub-tree is taken out, on the same worlds.
    """
    spec = RunSpec().overridden(options, settings_of(settings, ("domain",)))
    watch = options["validation"] is not None
    _check_coverage(coverage, watch=watch)
    registry = open_registry()
    domain = registry.make_domain(spec.domain, spec.settings("domain"))
    found = load_tree(tree, registry)
    dead = _dead(found, domain)
    seen = inspect_tree(found, domain, spec.seed, spec.validation) if watch else None
    if as_json:
        emit_json({"tree": format_tree(found), "domain": spec.domain} | _dead_json(dead) | _seen_json(found, seen))
    else:
        print("\n\n".join([_dead_lines(dead), *(_pages(found, seen, spec.domain) if seen else ())]))
    return NOT_COVERED if seen and coverage is not None and seen.coverage < coverage else SUCCESS


def _check_coverage(coverage: float | None, *, watch: bool) -> None:
    if coverage is None:
        return
    if not 0 <= coverage <= 100:  # noqa: PLR2004 - a percentage
        raise ParameterError(f"--coverage cannot be {coverage:g}", "give a percentage from 0 to 100")
    if not watch:
        raise ParameterError("--coverage needs episodes to look at", "add for example --episodes 200")


def _dead(tree: BehaviorTree, domain: Domain) -> tuple[DeadLeaf, ...]:
    vocabulary = domain.vocabulary
    compile_policy(tree, vocabulary.index)  # a leaf that the domain does not have is the first thing to say
    return dead_leaves(tree, vocabulary.results, vocabulary.is_pure)


def _dead_json(dead: tuple[DeadLeaf, ...]) -> dict[str, object]:
    return {"dead": [{"leaf": format_leaf(leaf.leaf), "occurrence": leaf.occurrence} for leaf in dead]}


def _seen_json(tree: BehaviorTree, seen: Inspection | None) -> dict[str, object]:
    if seen is None:
        return {}
    names = [{"node": label(node), "parent": parent} for node, parent in numbered(tree)]
    nodes = [name | attrs.asdict(count) for count, name in zip(seen.nodes, names, strict=True)]
    found: dict[str, object] = attrs.asdict(seen)
    return found | {"nodes": nodes, "never": seen.never, "coverage": seen.coverage}


def _dead_lines(dead: tuple[DeadLeaf, ...]) -> str:
    if not dead:
        return "no leaf is dead: each can run, by what the domain declares"
    return "\n".join(f"{format_leaf(leaf.leaf)} can never run (leaf {leaf.occurrence + 1})" for leaf in dead)


def _pages(tree: BehaviorTree, seen: Inspection, domain: str) -> tuple[str, ...]:
    heads = [f"{head:>9}" for head in ("VISITS", "SUCCESS", "FAILURE", "RUNNING")]
    rows = [(*_figures(count), line) for count, line in zip(seen.nodes, drawing(tree), strict=True)]
    visited = len(seen.nodes) - len(seen.never)
    return (
        f"{seen.episodes:,} episodes of {domain}; {_COUNTED[seen.counted]}",
        table([(*heads, "NODE"), *rows]),
        f"visited {visited} of {len(seen.nodes)} nodes, {seen.coverage:.1f} %",
        _ablation(seen),
    )


def _figures(count: NodeCount) -> tuple[str, ...]:
    answers = (count.success, count.failure, count.running)
    visits = f"{count.visits:,}" if count.visits else "never"
    return tuple(f"{text:>9}" for text in (visits, *("-" if each is None else f"{each:,}" for each in answers)))


def _ablation(seen: Inspection) -> str:
    if not seen.ablation:
        return "nothing can be taken out"
    rows = [(f"{row.change:+.4g}", f"{row.low:+.4g}", f"{row.high:+.4g}", row.subtree) for row in seen.ablation]
    return table([("CHANGE", "LOW", "HIGH", "OF THE MEAN RETURN WITHOUT"), *rows])
