"""A grammar as its author meant it: rules and directives, checked as far as that is possible without a domain."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from attrs import frozen

from grammarbt.errors import GrammarError, did_you_mean
from grammarbt.grammar.diagnostics import Diagnostic, GrammarFileError, Source, Span
from grammarbt.grammar.reader import read
from grammarbt.grammar.syntax import (
    Alternative,
    Choice,
    Declare,
    Expression,
    ForAll,
    Item,
    Limit,
    Literal,
    Reference,
    Repeat,
    Rule,
    Unique,
)

START = "start"
KINDS = ("ACTION", "CONDITION")


@frozen
class Grammar:
    """The rules and directives of a `.grammar` file.

    Attributes:
        source: the file.
        rules: in the order written.
        terminals: declared kinds of leaves.
        variables: names that range over the domain's groups.
        uniques, limits: the constraints.
    """

    source: Source
    rules: tuple[Rule, ...]
    terminals: tuple[str, ...]
    variables: tuple[str, ...]
    uniques: tuple[Unique, ...]
    limits: tuple[Limit, ...]

    @property
    def rule_names(self) -> tuple[str, ...]:
        """Every rule's name."""
        return tuple(rule.name for rule in self.rules)


def load_grammar(source: Source) -> Grammar:
    """Read a grammar and check what needs no domain.

    Raises:
        GrammarFileError: with every finding, not only the first.
    """
    grammar = _collect(source, read(source))
    findings = tuple(_findings(grammar))
    if findings:
        raise GrammarFileError(findings)
    return grammar


def read_grammar(path: Path) -> Grammar:
    """Read a grammar file.

    Raises:
        GrammarError: the file cannot be read.
        GrammarFileError: it is not a grammar.
    """
    return load_grammar(read_source(path))


def read_source(path: Path) -> Source:
    """The text of a grammar file."""
    try:
        return Source(str(path), path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "it is not text in UTF-8"
        raise GrammarError(
            f"cannot read the grammar {str(path)!r}: {reason}", "give the path of a .grammar file"
        ) from None


def direct_references(alternative: Alternative) -> Iterator[tuple[Reference, bool]]:
    """References of an alternative outside nested parentheses; the flag says whether it is a template argument."""
    for item in alternative.items:
        yield from _direct(item)


def _direct(item: Expression) -> Iterator[tuple[Reference, bool]]:
    if isinstance(item, Repeat):
        yield from _direct(item.item)
    elif isinstance(item, Reference):
        yield item, False
        yield from _argument_references(item)


def _argument_references(reference: Reference) -> Iterator[tuple[Reference, bool]]:
    for argument in reference.arguments:
        if isinstance(argument, Reference):
            yield argument, True
            yield from _argument_references(argument)


def all_references(alternatives: tuple[Alternative, ...]) -> Iterator[tuple[Reference, bool]]:
    """Every reference, also inside parentheses."""
    for alternative in alternatives:
        yield from direct_references(alternative)
        for item in alternative.items:
            inner = item.item if isinstance(item, Repeat) else item
            while isinstance(inner, Repeat):
                inner = inner.item
            if isinstance(inner, Choice):
                yield from all_references(inner.alternatives)


def _collect(source: Source, items: tuple[Item, ...]) -> Grammar:
    return Grammar(
        source,
        rules=tuple(item for item in items if isinstance(item, Rule)),
        terminals=tuple(name for item in items if isinstance(item, Declare) for name in item.names),
        variables=tuple(name for item in items if isinstance(item, ForAll) for name in item.variables),
        uniques=tuple(item for item in items if isinstance(item, Unique)),
        limits=tuple(item for item in items if isinstance(item, Limit)),
    )


def _findings(grammar: Grammar) -> Iterator[Diagnostic]:
    yield from _rule_findings(grammar)
    yield from _directive_findings(grammar)
    for rule in grammar.rules:
        for reference, is_argument in all_references(rule.alternatives):
            yield from _reference_findings(grammar, rule, reference, is_argument=is_argument)


def _rule_findings(grammar: Grammar) -> Iterator[Diagnostic]:
    seen: dict[str, Rule] = {}
    for rule in grammar.rules:
        if rule.name in seen:
            note = f"the first one is on line {seen[rule.name].span.line}"
            help_ = "join their alternatives with |, or rename one"
            yield Diagnostic("G202", f"rule `{rule.name}` is defined twice", rule.span, help_, (note,))
        seen.setdefault(rule.name, rule)
    if START not in seen:
        end = len(grammar.source.text)
        help_ = "add the rule that every tree begins with, for example `start: subtree`"
        yield Diagnostic("G207", "there is no rule `start`", Span(grammar.source, 0, min(end, 1)), help_)
    elif seen[START].parameters:
        yield Diagnostic("G206", "rule `start` cannot take parameters", seen[START].span, "remove them")


def _directive_findings(grammar: Grammar) -> Iterator[Diagnostic]:
    names = grammar.rule_names
    directives: tuple[Unique | Limit, ...] = (*grammar.uniques, *grammar.limits)
    for directive in directives:
        if directive.scope not in names:
            yield Diagnostic(
                "G201", f"undefined rule `{directive.scope}`", directive.span, did_you_mean(directive.scope, names)
            )
    for terminal in grammar.terminals:
        if terminal not in KINDS:
            span = _word_span(grammar.source, terminal)
            yield Diagnostic("G214", f"unknown kind of leaf `{terminal}`", span, did_you_mean(terminal, KINDS))
    for unique in grammar.uniques:
        known = (*grammar.terminals, *grammar.variables)
        for name in unique.names:
            if name not in known:
                message = f"`{name}` is neither a declared terminal nor a variable of %forall"
                yield Diagnostic("G211", message, unique.span, did_you_mean(name, known))
    for limit in grammar.limits:
        if limit.kind not in ("nodes", "depth"):
            help_ = did_you_mean(limit.kind, ("nodes", "depth"))
            yield Diagnostic("G212", f"there is no limit on `{limit.kind}`", limit.span, help_)


def _word_span(source: Source, word: str) -> Span:
    at = max(source.text.find(word), 0)
    return Span(source, at, at + len(word))


def _reference_findings(
    grammar: Grammar, rule: Rule, reference: Reference, *, is_argument: bool
) -> Iterator[Diagnostic]:
    name, span = reference.name, reference.span
    if name in rule.parameters or name in grammar.variables:
        return
    if name[0].isupper():
        yield from _terminal_findings(grammar, reference)
        return
    target = next((other for other in grammar.rules if other.name == name), None)
    if target is None:
        if not is_argument:  # an argument may name a group, which only a domain knows
            help_ = did_you_mean(name, grammar.rule_names)
            yield Diagnostic("G201", f"undefined rule `{name}`", span, help_)
    elif len(target.parameters) != len(reference.arguments):
        message = f"rule `{name}` takes {len(target.parameters)} parameters, not {len(reference.arguments)}"
        shape = f"{name}{{{', '.join(target.parameters)}}}" if target.parameters else name
        yield Diagnostic("G206", message, span, f"write `{shape}`")


def _terminal_findings(grammar: Grammar, reference: Reference) -> Iterator[Diagnostic]:
    if reference.name not in grammar.terminals:
        known = grammar.terminals or KINDS
        help_ = f"add `%declare {reference.name}`" if reference.name in KINDS else did_you_mean(reference.name, known)
        yield Diagnostic("G209", f"terminal `{reference.name}` is not declared", reference.span, help_)
    elif len(reference.arguments) > 1 or any(isinstance(part, Literal) for part in reference.arguments):
        help_ = f"write `{reference.name}` or `{reference.name}{{g}}`"
        yield Diagnostic("G206", f"terminal `{reference.name}` takes one group at most", reference.span, help_)
