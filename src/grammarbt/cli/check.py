"""`grammarbt check`: does a domain or a searcher keep to its protocol?"""

from __future__ import annotations

from typing import TYPE_CHECKING

import attrs
import click

from grammarbt.cli.app import open_registry
from grammarbt.cli.options import json_option
from grammarbt.cli.output import emit_json
from grammarbt.run.spec import settings_of
from grammarbt.testing import DOMAIN_CHECKS, SEARCHER_CHECKS, DomainSubject, SearcherSubject, verdicts

if TYPE_CHECKING:
    from collections.abc import Iterable

    from grammarbt.testing import Verdict

MARKS = {"ok": "ok  ", "failed": "FAIL", "not applicable": "-   "}


@click.command("check")
@click.argument("kind", type=click.Choice(["domain", "searcher"]))
@click.argument("name", metavar="NAME|FILE.py:NAME")
@click.option("--set", "settings", multiple=True, metavar="PART.KEY=VALUE", help="A parameter of it; repeatable.")
@json_option
def command(kind: str, name: str, settings: tuple[str, ...], as_json: bool) -> int:
    """Put a component to every check of the conformance kit.

    Exits with 1 when a check fails.
    """
    found = _checked(kind, name, settings)
    if as_json:
        listed = [attrs.asdict(verdict) for verdict in found]
        emit_json({"name": name, "kind": kind, "checks": listed, "ok": not _failures(listed)})
        return int(bool(_failures(listed)))
    listed = []
    for verdict in found:
        listed.append(attrs.asdict(verdict))
        print(_line(verdict), flush=True)
    failed = _failures(listed)
    print(f"{len(listed)} checks, {failed} failed" if failed else f"{len(listed)} checks, none failed")
    return int(bool(failed))


def _checked(kind: str, name: str, settings: tuple[str, ...]) -> Iterable[Verdict]:
    registry = open_registry()
    if kind == "domain":
        domain = DomainSubject(name, settings_of(settings, ("domain",)).get("domain", {}))
        registry.make_domain(name, domain.settings)  # a wrong name or setting is the user's mistake, not a finding
        return verdicts(DOMAIN_CHECKS, domain)
    searcher = SearcherSubject(name, settings_of(settings, ("searcher",)).get("searcher", {}))
    registry.searcher_parameters(name)
    return verdicts(SEARCHER_CHECKS, searcher)


def _failures(listed: Iterable[dict[str, object]]) -> int:
    return sum(verdict["status"] == "failed" for verdict in listed)


def _line(verdict: Verdict) -> str:
    text = [f"{MARKS[verdict.status]}  {verdict.check}"]
    if verdict.seen:
        text.append(f"        {verdict.seen}")
    if verdict.advice:
        text.append(f"        {verdict.advice}")
    return "\n".join(text)
