"""The grammars that come with grammarbt."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable

from grammarbt.grammar.diagnostics import Source

_SUFFIX = ".grammar"


@cache
def shipped_grammars() -> dict[str, Source]:
    """Name and text of every shipped grammar, by name."""
    folder = files("grammarbt") / "grammars"
    found = sorted((item for item in folder.iterdir() if item.name.endswith(_SUFFIX)), key=lambda item: item.name)
    return {_name(item): Source(item.name, item.read_text(encoding="utf-8")) for item in found}


def _name(item: Traversable) -> str:
    return item.name.removesuffix(_SUFFIX)
