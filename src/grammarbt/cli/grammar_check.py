"""`grammarbt grammar check`: everything that is wrong or odd about a grammar, and its figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from grammarbt.cli.app import open_registry
from grammarbt.cli.failures import SUCCESS, USER_MISTAKE
from grammarbt.cli.options import json_option
from grammarbt.cli.output import emit_json, table
from grammarbt.errors import GrammarError
from grammarbt.run.spec import settings_of

if TYPE_CHECKING:
    from grammarbt.grammar import BoundGrammar
    from grammarbt.grammar.check import Report, Summary


@click.command("check")
@click.argument("file")
@click.option("--domain", metavar="NAME|FILE.py:NAME", help="Whose leaves to bind to; made-up ones unless given.")
@click.option(
    "--set", "settings", multiple=True, metavar="domain.KEY=VALUE", help="A parameter of the domain; repeatable."
)
@json_option
def command(file: str, domain: str | None, settings: tuple[str, ...], as_json: bool) -> int:
    """Check the grammar FILE, or a shipped one by its name.

    Reports all findings at once; exits with 2 if one is an error. With a domain it also says which groups and leaves
    no word uses, whether the language is finite, and its smallest word.
    """
    from grammarbt.grammar.check import check_source  # noqa: PLC0415 - brings lark, which `--help` does not need

    registry = open_registry()
    vocabulary = (
        registry.make_domain(domain, settings_of(settings, ("domain",)).get("domain", {})).vocabulary
        if domain
        else None
    )
    report = check_source(registry.find_grammar(file), vocabulary, _words)
    if as_json:
        emit_json(report.as_json())
    else:
        print(_page(report))
    return USER_MISTAKE if report.errors else SUCCESS


def _words(bound: BoundGrammar) -> int | None:
    """How many words the language has, if that can be told."""
    from grammarbt.grammar import Counter, Language  # noqa: PLC0415 - as above

    try:
        return Counter(Language(bound)).words(bound.start_symbol)
    except GrammarError:
        return None


def _page(report: Report) -> str:
    parts = [finding.render() for finding in report.findings]
    if report.summary:
        parts.append(table(_rows(report.summary)))
    parts.append(f"{_many(len(report.errors), 'error')}, {_many(len(report.warnings), 'warning')}")
    return "\n\n".join(parts)


def _rows(summary: Summary) -> list[tuple[str, str]]:
    ambiguous = {True: "yes", False: "no", None: "no word found within the limit of the search"}[summary.ambiguous]
    return [
        ("groups", ", ".join(summary.groups)),
        ("productions", f"{summary.productions:,}"),
        ("finite", "yes" if summary.finite else "no"),
        *([] if summary.words is None else [("words", f"{summary.words:,}")]),
        ("ambiguous", ambiguous),
        ("smallest word", summary.smallest or "not found within the limit of the search"),
    ]


def _many(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"
