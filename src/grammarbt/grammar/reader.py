"""From the text of a `.grammar` file to its syntax tree."""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files
from typing import Any

from lark import Lark, Token, Transformer, UnexpectedCharacters, UnexpectedInput, UnexpectedToken, v_args
from lark.exceptions import VisitError

from grammarbt.grammar.diagnostics import Diagnostic, GrammarFileError, Source, Span
from grammarbt.grammar.syntax import (
    Alternative,
    Choice,
    Declare,
    ForAll,
    Import,
    Item,
    Limit,
    Literal,
    Reference,
    Repeat,
    Rule,
    Unique,
)

MAX_CHARACTERS = 200_000
MAX_TOKENS = 15_000
MAX_NESTING = 40
MAX_REPEAT = 1_000

_WORD_OR_SIGN = r'"(?:\\.|[^"\\\n])*"|//[^\n]*|([(\[{])|([)\]}])|\w+|[^\w\s]'

_NAMES = {
    "_OR": "'|'", "_CLOSE": "')'", "_CLOSE_OPTIONAL": "']'", "_NL": "a new line", "COLON": "':'", "LPAR": "'('",
    "LSQB": "'['", "STRING": "a string", "NAME": "a rule name", "TERMINAL": "a terminal", "$END": "the end",
    "AT": "'@'", "__ANON_0": "'->'", "LBRACE": "'{'", "RBRACE": "'}'", "COMMA": "','", "OPERATOR": "'?', '*' or '+'",
    "TILDE": "'~'", "INTEGER": "a number", "NUMBER": "a number", "IN": "'in'", "DOT": "'.'", "DOTS": "'.'",
}  # fmt: skip


def read(source: Source) -> tuple[Item, ...]:
    """Parse a grammar file.

    Raises:
        GrammarFileError: with code G100 (syntax), G101 (nested too deeply), G102 (too large).
    """
    _check_size(source)
    try:
        tree = _parser().parse(source.text)
    except UnexpectedInput as error:
        raise GrammarFileError([_syntax_error(source, error)]) from None
    try:
        return tuple(_Builder(source).transform(tree))
    except VisitError as error:
        raise error.orig_exc from None


@cache
def _parser() -> Lark:
    text = (files("grammarbt.grammar") / "grammar.lark").read_text(encoding="utf-8")
    return Lark(text, parser="lalr", propagate_positions=True, maybe_placeholders=True)


def _check_size(source: Source) -> None:
    if len(source.text) > MAX_CHARACTERS:
        message = f"the file has {len(source.text):,} characters; a grammar has at most {MAX_CHARACTERS:,}"
        raise GrammarFileError([Diagnostic("G102", message, None, "split it, and use templates for what repeats")])
    level = 0
    for number, match in enumerate(re.finditer(_WORD_OR_SIGN, source.text)):
        if number == MAX_TOKENS:
            message, help_ = f"the file has more than {MAX_TOKENS:,} words and signs", "use templates for what repeats"
            raise GrammarFileError([Diagnostic("G102", message, Span(source, match.start(), match.end()), help_)])
        level += bool(match.group(1)) - bool(match.group(2))
        if level > MAX_NESTING:
            span = Span(source, match.start(), match.end())
            help_ = "give the inner part a rule of its own"
            raise GrammarFileError([Diagnostic("G101", f"nested deeper than {MAX_NESTING} levels", span, help_)])


def _syntax_error(source: Source, error: UnexpectedInput) -> Diagnostic:
    at: Any = error.pos_in_stream
    if at is None or not 0 <= at <= len(source.text):  # lark gives -1 where the text ends too early
        at = len(source.text)
    if isinstance(error, UnexpectedToken):
        length = len(error.token) if error.token.type != "$END" else 1
        expected = _expected(error.accepts or error.expected)
        what = "the file ends here" if error.token.type == "$END" else f"did not expect {str(error.token).strip()!r}"
    else:
        length = 1
        expected = _expected(error.allowed) if isinstance(error, UnexpectedCharacters) and error.allowed else ""
        what = f"did not expect {source.text[at : at + 1]!r}"
    message, help_ = _known_mistake(source, at) or (what, f"expected {expected}" if expected else "")
    return Diagnostic("G100", message, Span(source, at, at + length), help_)


def _expected(names: Any) -> str:  # noqa: ANN401  lark types its token sets loosely
    shown = sorted({_NAMES.get(name, f"'%{name.lower().lstrip('_')}'") for name in names if name != "_NL"})
    return " or ".join(shown[:6])


def _known_mistake(source: Source, at: int) -> tuple[str, str] | None:
    rest, line = source.text[at : at + 40], source.text[:at].rpartition("\n")[2]
    if rest.startswith("/"):
        return (
            "regular expressions have no place here",
            "a grammar generates trees: write leaves as strings or terminals",
        )
    if rest.startswith('"'):
        return "this string is never closed", 'add " before the end of the line'
    if rest.startswith("%"):
        known = "%declare, %forall, %unique, %limit, %import"
        return f"unknown directive {rest.split()[0]!r}", f"known: {known}"
    if rest.startswith(("→", "?(", "!")) or (rest.startswith("|") and not line.strip()):
        return f"did not expect {rest[0]!r}", 'signs of the notation stand in quotes, as in "→" "(" x ")"'
    if re.match(r"[A-Z]\w*\s*:", rest):
        return "terminals are declared, not defined", "use a lower-case rule, or %declare ACTION CONDITION"
    return None


class _Builder(Transformer[Token, Any]):
    """Turns lark's tree into ours, bottom up."""

    def __init__(self, source: Source) -> None:
        super().__init__()
        self.source = source

    def span(self, meta: Any) -> Span:  # noqa: ANN401  lark's Meta has no static attributes
        return Span(self.source, getattr(meta, "start_pos", 0), getattr(meta, "end_pos", 0))

    def token_span(self, token: Token) -> Span:
        start = token.start_pos or 0
        return Span(self.source, start, start + len(token))

    def start(self, items: list[Item | None]) -> list[Item]:
        return [item for item in items if item is not None]

    def rule(self, parts: list[Any]) -> Rule:
        name, parameters, alternatives = parts
        return Rule(str(name), parameters or (), alternatives, self.token_span(name))

    def parameters(self, names: list[Token]) -> tuple[str, ...]:
        return tuple(map(str, names))

    def alternatives(self, parts: list[Alternative]) -> tuple[Alternative, ...]:
        return tuple(parts)

    @v_args(meta=True)
    def alternative(self, meta: Any, parts: list[Any]) -> Alternative:  # noqa: ANN401
        *items, weight, alias = parts
        span = self.span(meta) if items else self.span(None)
        if weight is not None and not 0 < float(weight) < float("inf"):
            message = f"a weight of {weight} says nothing"
            raise GrammarFileError([Diagnostic("G103", message, self.token_span(weight), "use a number above 0")])
        return Alternative(tuple(items), 1.0 if weight is None else float(weight), alias and str(alias), span)

    @v_args(meta=True)
    def operator(self, meta: Any, parts: list[Any]) -> Repeat:  # noqa: ANN401
        least, most = {"?": (0, 1), "*": (0, None), "+": (1, None)}[parts[1]]
        return Repeat(parts[0], least, most, self.span(meta))

    @v_args(meta=True)
    def times(self, meta: Any, parts: list[Any]) -> Repeat:  # noqa: ANN401
        item, least, most = parts
        most = least if most is None else most
        for number in (least, most):
            if len(number) > len(str(MAX_REPEAT)) or int(number) > MAX_REPEAT:
                message = f"repeating {number[:12]} times is too much; at most {MAX_REPEAT:,} are possible"
                raise GrammarFileError([Diagnostic("G102", message, self.token_span(number), "use * or +, and %limit")])
        if int(most) < int(least) or int(most) == 0:
            message = f"there is no number of times from {least} to {most}"
            raise GrammarFileError([Diagnostic("G104", message, self.span(meta), "write the smaller number first")])
        return Repeat(item, int(least), int(most), self.span(meta))

    @v_args(meta=True)
    def group(self, meta: Any, parts: list[Any]) -> Choice:  # noqa: ANN401
        return Choice(parts[0], optional=False, span=self.span(meta))

    @v_args(meta=True)
    def optional(self, meta: Any, parts: list[Any]) -> Choice:  # noqa: ANN401
        return Choice(parts[0], optional=True, span=self.span(meta))

    def literal(self, parts: list[Token]) -> Literal:
        text = re.sub(r"\\(.)", r"\1", parts[0][1:-1])
        return Literal(text, self.token_span(parts[0]))

    @v_args(meta=True)
    def reference(self, meta: Any, parts: list[Any]) -> Reference:  # noqa: ANN401
        name, arguments = parts
        return Reference(str(name), arguments or (), self.span(meta))

    def arguments(self, parts: list[Any]) -> tuple[Any, ...]:
        return tuple(parts)

    @v_args(meta=True)
    def declare(self, meta: Any, names: list[Token]) -> Declare:  # noqa: ANN401
        return Declare(tuple(map(str, names)), self.span(meta))

    @v_args(meta=True)
    def forall(self, meta: Any, names: list[Token]) -> ForAll:  # noqa: ANN401
        *variables, domain = map(str, names)
        return ForAll(tuple(variables), domain, self.span(meta))

    @v_args(meta=True)
    def unique(self, meta: Any, names: list[Token]) -> Unique:  # noqa: ANN401
        *what, scope = map(str, names)
        return Unique(tuple(what), scope, self.span(meta))

    @v_args(meta=True)
    def limit(self, meta: Any, parts: list[Any]) -> Limit:  # noqa: ANN401
        kind, number, scope = parts
        most = int(number) if len(number) < len(str(MAX_CHARACTERS)) else MAX_CHARACTERS
        return Limit(str(kind), most, "start" if scope is None else str(scope), self.span(meta))

    @v_args(meta=True)
    def import_rule(self, meta: Any, parts: list[Any]) -> Import:  # noqa: ANN401
        (level, names), alias = parts
        *module, rule = names
        return Import(level, tuple(module), ((rule, str(alias or rule)),), self.span(meta))

    @v_args(meta=True)
    def import_names(self, meta: Any, parts: list[Any]) -> Import:  # noqa: ANN401
        (level, module), *rules = parts
        return Import(level, tuple(module), tuple((str(rule), str(rule)) for rule in rules), self.span(meta))

    def path(self, parts: list[Any]) -> tuple[int, list[str]]:
        dots, *names = parts
        return len(dots or ""), [str(name) for name in names]
