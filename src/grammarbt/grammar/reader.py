"""From the text of a `.grammar` file to its syntax tree."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache
from importlib.resources import files
from itertools import islice
from typing import Any

from lark import Lark, UnexpectedInput, UnexpectedToken

from grammarbt.grammar.builder import build
from grammarbt.grammar.diagnostics import MAX_FINDINGS, Diagnostic, GrammarFileError, Source, Span
from grammarbt.grammar.syntax import Item

MAX_CHARACTERS = 200_000
MAX_TOKENS = 15_000
MAX_NESTING = 40

_STRING = r'"(?:\\.|[^"\\\n])*"'
_WORD_OR_SIGN = re.compile(_STRING + r"|//[^\n]*|([(\[{])|([)\]}])|\w+|[^\w\s]")

_HEAD = re.compile(r"^[ \t]*(?:%|\w+[ \t]*(?:\{[^}\n]*\})?[ \t]*[:=])", re.MULTILINE)
"""What a rule or directive begins with; some write = for the colon."""

_GOES_ON = "a rule goes on in the next line only if that begins with |, ) or ]"

_NAMES = {
    "_OR": "'|'", "_CLOSE": "')'", "_CLOSE_OPTIONAL": "']'", "_NL": "a new line", "COLON": "':'", "LPAR": "'('",
    "LSQB": "'['", "STRING": "a string", "NAME": "a rule name", "TERMINAL": "a terminal", "$END": "the end",
    "AT": "'@'", "__ANON_0": "'->'", "LBRACE": "'{'", "RBRACE": "'}'", "COMMA": "','", "OPERATOR": "'?', '*' or '+'",
    "TILDE": "'~'", "INTEGER": "a number", "NUMBER": "a number", "IN": "'in'", "DOT": "'.'", "DOTS": "'.'",
}  # fmt: skip


def read(source: Source) -> tuple[Item, ...]:
    """Parse a grammar file, statement by statement, so that each one can have its own errors.

    Raises:
        GrammarFileError: with codes G100 (syntax), G101 (nested too deeply), G102 (too large), G103 (weights), G104
            (repetitions).
    """
    _check_size(source)
    items: list[Item] = []
    findings: list[Diagnostic] = []
    for start, end in _statements(source.text):
        items += _statement(source, start, end, findings)
    if findings:
        raise GrammarFileError(findings[:MAX_FINDINGS])
    return tuple(items)


def _statement(source: Source, start: int, end: int, findings: list[Diagnostic]) -> list[Item]:
    too_deep = _nesting_error(source, start, end)
    if too_deep:
        findings.append(too_deep)
        return []
    try:
        tree = _parser().parse(source.text[start:end].rstrip())
    except UnexpectedInput as error:
        findings.append(_syntax_error(source, start, error))
        return []
    return build(tree, source, start, findings)


def _statements(text: str) -> Iterator[tuple[int, int]]:
    """Where each rule or directive begins and ends; what stands before the first is part of none, but read, too."""
    starts = [0, *(found.start() for found in _HEAD.finditer(text) if found.start())]
    return zip(starts, [*starts[1:], len(text)], strict=True)


@cache
def _parser() -> Lark:
    text = (files("grammarbt.grammar") / "grammar.lark").read_text(encoding="utf-8")
    return Lark(text, parser="lalr", propagate_positions=True, maybe_placeholders=True)


def _check_size(source: Source) -> None:
    if len(source.text) > MAX_CHARACTERS:
        message = f"the file has {len(source.text):,} characters; a grammar has at most {MAX_CHARACTERS:,}"
        raise GrammarFileError([Diagnostic("G102", message, None, "split it, and use templates for what repeats")])
    words = [*islice(_WORD_OR_SIGN.finditer(source.text), MAX_TOKENS + 1)]
    if len(words) > MAX_TOKENS:
        message, help_ = f"the file has more than {MAX_TOKENS:,} words and signs", "use templates for what repeats"
        raise GrammarFileError([Diagnostic("G102", message, Span(source, *words[-1].span()), help_)])


def _nesting_error(source: Source, start: int, end: int) -> Diagnostic | None:
    level = 0
    for match in _WORD_OR_SIGN.finditer(source.text, start, end):
        level += bool(match.group(1)) - bool(match.group(2))
        if level > MAX_NESTING:
            message, help_ = f"nested deeper than {MAX_NESTING} levels", "give the inner part a rule of its own"
            return Diagnostic("G101", message, Span(source, *match.span()), help_)
    return None


def _syntax_error(source: Source, start: int, error: UnexpectedInput) -> Diagnostic:
    at, length, what = _unexpected(source.text, start, error)
    help_ = _GOES_ON if _is_on_next_line(source.text, start, at) else f"expected {_expected(error)}"
    message, help_ = _known_mistake(source.text, at) or (what, help_)
    return Diagnostic("G100", message, Span(source, at, at + length), help_)


def _unexpected(text: str, start: int, error: UnexpectedInput) -> tuple[int, int, str]:
    """Where a statement goes wrong, over how many characters, and what is wrong there."""
    if not isinstance(error, UnexpectedToken):
        place: Any = error.pos_in_stream  # lark declares it as None
        at = start + place
        return at, 1, f"did not expect {text[at]!r}"
    token = error.token
    if token.type == "$END":
        what = "directive" if text[start:].lstrip().startswith("%") else "rule"
        return start + token.end_pos, 1, f"the {what} ends too early"
    if token.type == "_NL":
        at = start + token.end_pos
        return at, 1, f"did not expect {text[at]!r}"
    return start + token.start_pos, len(token), f"did not expect {token.strip()!r}"


def _is_on_next_line(text: str, start: int, at: int) -> bool:
    """Whether a rule goes on where it cannot: in a line that begins with anything but |, ) or ]."""
    line = text.rfind("\n", 0, at) + 1
    return line > start and bool(_HEAD.match(text, start)) and text[line:].lstrip()[:1] not in "|)]"


def _expected(error: UnexpectedInput) -> str:
    possible = (getattr(error, name, None) for name in ("accepts", "expected", "allowed"))
    names: Iterable[str] = next(filter(None, possible), ())
    shown = sorted({_NAMES.get(name, f"'%{name.lower().lstrip('_')}'") for name in names if name != "_NL"})
    return " or ".join(shown[:6])


def _known_mistake(text: str, at: int) -> tuple[str, str] | None:
    rest, line = text[at : at + 40], text[:at].rpartition("\n")[2]
    if rest.startswith("/"):
        return (
            "regular expressions have no place here",
            "a grammar generates trees: write leaves as strings or terminals",
        )
    if rest.startswith('"') and not re.compile(_STRING).match(text, at):
        return "this string is never closed", 'add " before the end of the line'
    if rest.startswith("%"):
        known = "%declare, %forall, %unique, %limit, %import"
        return f"unknown directive {rest.split()[0]!r}", f"known: {known}"
    if rest.startswith(("→", "?(", "!")) or (rest.startswith("|") and not line.strip()):
        return f"did not expect {rest[0]!r}", 'signs of the notation stand in quotes, as in "→" "(" x ")"'
    if re.match(r"[A-Z]\w*\s*:", rest):
        return "terminals are declared, not defined", "use a lower-case rule, or %declare ACTION CONDITION"
    return None
