"""Where a run comes from: the command that makes it again, versions, parameters, the grammar."""

from __future__ import annotations

import json
import shlex
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, cast

from attrs import fields

from grammarbt.report.markup import Markup, details, element, paragraph, section, table
from grammarbt.run.spec import RunSpec

if TYPE_CHECKING:
    from grammarbt.report.history import History

_SPEC_ONLY = ("selection", "snapshot")
"""What only a SPEC.toml can set."""

_NEW = "out"
"""A run is repeated in a new folder."""


def command_of(history: History) -> str:
    """The command that makes the run again, to the same journal, in a new folder."""
    spec = cast("Mapping[str, Any]", history.resolved["spec"])
    usual = {attribute.name: attribute.default for attribute in fields(RunSpec)}
    if any(spec[name] != usual[name] for name in _SPEC_ONLY if name in spec):
        return shlex.join(["grammarbt", "run", str(history.folder / "spec.toml"), "--out", "NEW"])
    return shlex.join(["grammarbt", "run", *_options(spec), *_settings(spec)])


def origin(history: History) -> Markup:
    """The section about it."""
    resolved = history.resolved
    grammar = cast("Mapping[str, str]", resolved["grammar"])
    versions = cast("Mapping[str, str]", resolved["versions"])
    return section(
        "origin",
        "Where it comes from",
        paragraph(
            f"Seed {history.seed}, grammarbt {versions.get('grammarbt', '?')}. This command makes it again, trial by trial, in a new folder:"
        ),
        element("pre", element("code", command_of(history)), tabindex="0"),
        details("Parameters and seed", table("Parameters", ("Parameter", "Value"), _parameters(resolved))),
        details("Versions", table("Versions", ("Software", "Version"), versions.items())),
        details(f"The grammar {grammar['name']}", element("pre", element("code", grammar["text"]), tabindex="0")),
    )


def _options(spec: Mapping[str, Any]) -> Iterator[str]:
    for name, value in spec.items():
        if value is not None and name not in ("set", _NEW, *_SPEC_ONLY):
            yield from (f"--{name}", str(value))


def _settings(spec: Mapping[str, Any]) -> Iterator[str]:
    for part, given in spec.get("set", {}).items():
        for name, value in given.items():
            yield from ("--set", f"{part}.{name}={value if isinstance(value, str) else json.dumps(value)}")


def _parameters(resolved: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    yield "seed", str(resolved["seed"])
    yield "budget", f"{resolved['budget']:,}"
    yield "batch", str(resolved["batch"])
    for part in ("searcher", "domain"):
        yield part, resolved[part]["name"]
        yield from ((f"{part}.{name}", str(value)) for name, value in resolved[part]["parameters"].items())
    yield "grammar", f"{resolved['grammar']['name']}, {resolved['grammar']['fingerprint']}"
