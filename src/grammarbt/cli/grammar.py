"""`grammarbt grammar`: check a grammar, count and sample its trees, read trees back."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import click

from grammarbt.cli.app import open_registry
from grammarbt.cli.failures import SUCCESS
from grammarbt.cli.grammar_check import command as check
from grammarbt.cli.options import domain_settings, json_option
from grammarbt.cli.output import emit_json, table
from grammarbt.run.spec import settings_of

if TYPE_CHECKING:
    from grammarbt.grammar import BoundGrammar, Count, Derivation, Likely, NotInLanguageError
    from grammarbt.plugins import Registry

Answer = TypeVar("Answer")

NOT_IN_LANGUAGE = 1
"""Exit status of `grammar parse` when the tree is not in the language."""

BATCH = 1_000


class DomainOptions(NamedTuple):
    """Whose leaves a verb uses: a domain's name, and its settings as typed."""

    name: str
    settings: tuple[str, ...]


def _domain(verb: Callable[..., Answer]) -> Callable[..., Answer]:
    """Add the options of a domain to a verb, which gets them as one argument."""

    @click.option("--domain", required=True, metavar="NAME|FILE.py:NAME", help="Whose leaves to use.")
    @domain_settings
    @wraps(verb)
    def with_domain(domain: str, settings: tuple[str, ...], **others: object) -> Answer:
        return verb(domain=DomainOptions(domain, settings), **others)

    return with_domain


@click.group("grammar", context_settings={"help_option_names": ["-h", "--help"]})
def command() -> None:
    """Check a grammar, count and sample its trees, read trees back.

    FILE is a .grammar file, or the name of a shipped one.
    """


command.add_command(check)


@command.command("count")
@click.argument("file")
@_domain
@json_option
def count(file: str, domain: DomainOptions, as_json: bool) -> None:
    """Count derivations, distinct trees and distinct behaviours of FILE, exactly.

    Behaviours are counted where there are at most 200,000 trees, as that takes listing them; derivations and trees
    unless some hundred thousand steps do not suffice. What passes these limits is `too many`, in JSON null; so is a
    group that only the limits of the whole tree keep finite.
    """
    from grammarbt.grammar import Counter, Language  # noqa: PLC0415 - brings lark, which `--help` does not need

    bound = _bound(file, domain, open_registry())
    counter = Counter(Language(bound))
    groups, whole = counter.groups(), counter.count(bound.start_symbol)
    if as_json:
        shown = {name: _count_json(size) for name, size in groups.items()}
        emit_json({"groups": shown, **_count_json(whole)})
    else:
        rows = [_row(name, size) for name, size in [*groups.items(), ("whole trees", whole)]]
        print(table([("", "derivations", "words", "behaviours"), *rows]))


@command.command("sample")
@click.argument("file")
@_domain
@click.option("-n", "number", type=click.IntRange(min=0), default=1, show_default=True, help="How many trees.")
@click.option("--seed", type=click.IntRange(min=0), default=0, show_default=True, help="The same seed, the same trees.")
@click.option(
    "--uniform",
    type=click.Choice(["words", "derivations", "choices"]),
    default="words",
    show_default=True,
    help="What is equally likely; `choices` goes by the weights of the alternatives and is for any language.",
)
def sample(file: str, domain: DomainOptions, number: int, seed: int, uniform: Likely) -> None:
    """Print random trees of FILE, one a line."""
    import numpy as np  # noqa: PLC0415 - only this verb needs it

    from grammarbt.bt import format_tree  # noqa: PLC0415
    from grammarbt.grammar import sampler  # noqa: PLC0415

    bound = _bound(file, domain, open_registry())
    draw, rng = sampler(bound, uniform), np.random.default_rng(seed)
    for done in range(0, number, BATCH):
        for word in draw(rng, min(BATCH, number - done)):
            print(format_tree(bound.tree_of(word)))


@command.command("parse")
@click.argument("file")
@click.argument("tree")
@_domain
@json_option
def parse(file: str, tree: str, domain: DomainOptions, as_json: bool) -> int:
    """Say how FILE derives TREE, or where TREE leaves the language; exits with 1 if it does."""
    from grammarbt.grammar import NotInLanguageError, parse_tree  # noqa: PLC0415 - brings lark
    from grammarbt.run.trees import load_tree  # noqa: PLC0415

    registry = open_registry()
    bound = _bound(file, domain, registry)
    try:
        derivation = parse_tree(bound, load_tree(tree, registry))
    except NotInLanguageError as error:
        _show_departure(error, as_json=as_json)
        return NOT_IN_LANGUAGE
    _show_derivation(bound, derivation, as_json=as_json)
    return SUCCESS


def _bound(file: str, domain: DomainOptions, registry: Registry) -> BoundGrammar:
    from grammarbt.grammar import bind, load_grammar  # noqa: PLC0415 - brings lark, which `--help` does not need

    settings = settings_of(domain.settings, ("domain",)).get("domain", {})
    return bind(load_grammar(registry.find_grammar(file)), registry.make_domain(domain.name, settings).vocabulary)


def _count_json(size: Count) -> dict[str, int | None]:
    return {"derivations": size.derivations, "words": size.words, "behaviours": size.behaviours}


def _row(name: str, size: Count) -> tuple[str, ...]:
    return (name, *("too many" if figure is None else f"{figure:,}" for figure in _count_json(size).values()))


def _show_derivation(bound: BoundGrammar, derivation: Derivation, *, as_json: bool) -> None:
    steps = [{"production": number, "text": bound.production_text(number)} for number in derivation]
    if as_json:
        emit_json({"member": True, "derivation": steps})
    else:
        for step in steps:
            print(step["text"])


def _show_departure(error: NotInLanguageError, *, as_json: bool) -> None:
    if as_json:
        shown = {"place": error.place, "before": error.before, "found": error.found}
        emit_json({"member": False, **shown, "possible": error.possible, "closest": error.closest})
        return
    start = f"{error.before} " if error.before else ""
    print(f"{start}{error.found}\n{' ' * len(start)}{'^' * len(error.found)}")
    print(f"{error.message}\n{error.hint}")
