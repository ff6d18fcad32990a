"""What is wrong with a grammar, where, and what to do: the values, and how they look on a terminal."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Literal

from attrs import field, frozen

from grammarbt.errors import GrammarError

MAX_FINDINGS = 30
"""Findings reported at a time."""


@frozen
class Source:
    """A grammar file.

    Attributes:
        name: as shown to people.
        text: what it says.
        folder: where its neighbours are; the shipped grammars need none.
        neighbours: their texts by name without suffix, if these are known; then the folder does not matter.
    """

    name: str
    text: str
    folder: Path | None = field(default=None, eq=False)
    neighbours: Mapping[str, str] | None = field(default=None, eq=False)


@frozen
class Span:
    """A stretch of a source, by character offsets; `end` is exclusive."""

    source: Source
    start: int
    end: int

    @property
    def line(self) -> int:
        """The line it starts on, from 1."""
        return self.source.text.count("\n", 0, self.start) + 1

    @property
    def column(self) -> int:
        """The column it starts at, from 1."""
        return self.start - self.source.text.rfind("\n", 0, self.start)

    @property
    def line_text(self) -> str:
        """The whole line it starts on."""
        first = self.source.text.rfind("\n", 0, self.start) + 1
        return self.source.text[first:].partition("\n")[0].rstrip("\r")

    @property
    def text(self) -> str:
        """The stretch itself."""
        return self.source.text[self.start : self.end]

    def word(self, word: str) -> Span:
        """Where a word first stands inside."""
        found = re.search(rf"\b{re.escape(word)}\b", self.text)
        at = self.start + (found.start() if found else 0)
        return Span(self.source, at, at + len(word))


@frozen
class Diagnostic:
    """One finding.

    Attributes:
        code: stable, `G` and three digits; each has a page in the docs.
        message: what is wrong.
        span: where, or None when it concerns the whole grammar.
        help: what to do.
        notes: why, a line each.
    """

    code: str
    message: str
    span: Span | None = None
    help: str = ""
    notes: tuple[str, ...] = ()
    severity: Literal["error", "warning"] = "error"

    @property
    def place(self) -> str:
        """`file:line:column`, or the empty string."""
        return f"{self.span.source.name}:{self.span.line}:{self.span.column}" if self.span else ""

    def render(self) -> str:
        """Several lines: the place, the source line, a caret under the stretch, the reason and the way out."""
        head = f"{self.place or 'grammar'}: {self.severity}[{self.code}]: {self.message}"
        lines = [head, *self._excerpt()]
        margin = " " * (len(str(self.span.line)) if self.span else 1)
        lines += [f"{margin}  = {note}" for note in self.notes]
        if self.help:
            lines.append(f"{margin}  = help: {self.help}")
        return "\n".join(lines)

    def as_json(self) -> dict[str, Any]:
        """For editors and scripts: the place in lines and columns from 1, the end exclusive."""
        end = self.span and Span(self.span.source, self.span.end, self.span.end)
        return {
            "code": self.code,
            "severity": self.severity,
            "message": self.message,
            "help": self.help,
            "notes": list(self.notes),
            "file": self.span and self.span.source.name,
            "line": self.span and self.span.line,
            "column": self.span and self.span.column,
            "end_line": end and end.line,
            "end_column": end and end.column,
        }

    def _excerpt(self) -> list[str]:
        if self.span is None:
            return []
        number, source = str(self.span.line), self.span.line_text
        margin = " " * len(number)
        width = max(1, min(self.span.end - self.span.start, len(source) - self.span.column + 1))
        lead = "".join("\t" if char == "\t" else " " for char in source[: self.span.column - 1])
        return [f"{margin} |", f"{number} | {source}", f"{margin} | {lead}{'^' * width}"]


class GrammarFileError(GrammarError):
    """A grammar cannot be used; `diagnostics` holds every finding, errors first."""

    def __init__(self, diagnostics: Iterable[Diagnostic]) -> None:
        self.diagnostics = tuple(sorted(diagnostics, key=_order))
        first = self.diagnostics[0]
        where = f"{first.place}: " if first.place else ""
        super().__init__(f"{where}error[{first.code}]: {first.message}", first.help or None)

    def render(self) -> str:
        """All findings, one after the other."""
        return "\n\n".join(diagnostic.render() for diagnostic in self.diagnostics)


def _order(diagnostic: Diagnostic) -> tuple[bool, str, int, str]:
    span = diagnostic.span
    return (
        diagnostic.severity != "error",
        span.source.name if span else "",
        span.start if span else 0,
        diagnostic.code,
    )
