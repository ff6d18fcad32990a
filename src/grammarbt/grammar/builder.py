"""From lark's tree of a statement to its syntax tree."""

from __future__ import annotations

import re
from typing import Any

from lark import Token, Transformer, Tree, v_args

from grammarbt.grammar.diagnostics import Diagnostic, Source, Span
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

MAX_REPEAT = 1_000
MAX_LIMIT = 200_000


def build(tree: Tree[Token], source: Source, offset: int, findings: list[Diagnostic]) -> list[Item]:
    """The items of a statement that begins at an offset of the source; numbers that make no sense become findings."""
    items: list[Item] = _Builder(source, offset, findings).transform(tree)
    return items


class _Builder(Transformer[Token, Any]):
    """Turns lark's tree into ours, bottom up."""

    def __init__(self, source: Source, offset: int, findings: list[Diagnostic]) -> None:
        super().__init__()
        self.source, self.offset, self.findings = source, offset, findings

    def find(self, code: str, message: str, span: Span, help_: str) -> None:
        self.findings.append(Diagnostic(code, message, span, help_))

    def span(self, meta: Any) -> Span:  # noqa: ANN401  lark's Meta has no static attributes
        start, end = getattr(meta, "start_pos", 0), getattr(meta, "end_pos", 0)
        return Span(self.source, self.offset + start, self.offset + end)

    def token_span(self, token: Token) -> Span:
        start = self.offset + (token.start_pos or 0)
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
            self.find("G103", f"a weight of {weight} says nothing", self.token_span(weight), "use a number above 0")
        return Alternative(tuple(items), 1.0 if weight is None else float(weight), alias and str(alias), span)

    @v_args(meta=True)
    def operator(self, meta: Any, parts: list[Any]) -> Repeat:  # noqa: ANN401
        least, most = {"?": (0, 1), "*": (0, None), "+": (1, None)}[parts[1]]
        return Repeat(parts[0], least, most, self.span(meta))

    @v_args(meta=True)
    def times(self, meta: Any, parts: list[Any]) -> Repeat:  # noqa: ANN401
        item, least, most = parts
        most = least if most is None else most
        for number in dict.fromkeys((least, most)):
            if len(number) > len(str(MAX_REPEAT)) or int(number) > MAX_REPEAT:
                message = f"repeating {number[:12]} times is too much; at most {MAX_REPEAT:,} are possible"
                self.find("G102", message, self.token_span(number), "use * or +, and %limit")
                return Repeat(item, 0, None, self.span(meta))
        if int(most) < int(least) or int(most) == 0:
            message = f"there is no number of times from {least} to {most}"
            self.find("G104", message, self.span(meta), "write the smaller number first")
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
        most = int(number) if len(number) < len(str(MAX_LIMIT)) else MAX_LIMIT
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
