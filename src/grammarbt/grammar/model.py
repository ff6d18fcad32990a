"""A grammar as its author meant it: rules and directives, checked as far as that is possible without a domain."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from itertools import islice
from pathlib import Path

from attrs import frozen

from grammarbt.errors import did_you_mean
from grammarbt.grammar.diagnostics import MAX_FINDINGS, Diagnostic, GrammarFileError, Source, Span
from grammarbt.grammar.imports import read_source, with_imports
from grammarbt.grammar.reader import read
from grammarbt.grammar.syntax import (
    Declare,
    ForAll,
    Item,
    Limit,
    Reference,
    Rule,
    Unique,
    references,
)

START = "start"
KINDS = ("ACTION", "CONDITION")
MAX_NAMES = 300


@frozen(slots=False)  # slots=False: cached_property keeps its value in the instance's dict
class Grammar:
    """The rules and directives of a `.grammar` file.

    Attributes:
        source: the file.
        rules: in the order written.
        declares, foralls: directives that declare kinds of leaves and variables.
        uniques, limits: the constraints.
    """

    source: Source
    rules: tuple[Rule, ...]
    declares: tuple[Declare, ...]
    foralls: tuple[ForAll, ...]
    uniques: tuple[Unique, ...]
    limits: tuple[Limit, ...]

    @cached_property
    def terminals(self) -> tuple[str, ...]:
        """Declared kinds of leaves."""
        return tuple(dict.fromkeys(name for item in self.declares for name in item.names))

    @cached_property
    def variables(self) -> tuple[str, ...]:
        """Names that range over the domain's groups."""
        return tuple(dict.fromkeys(name for item in self.foralls for name in item.variables))

    @cached_property
    def rule_names(self) -> tuple[str, ...]:
        """Every rule's name."""
        return tuple(self.by_name)

    @cached_property
    def by_name(self) -> dict[str, Rule]:
        """Each rule, the first of those that share a name."""
        found: dict[str, Rule] = {}
        for rule in self.rules:
            found.setdefault(rule.name, rule)
        return found


def load_grammar(source: Source) -> Grammar:
    """Read a grammar and check what needs no domain.

    Raises:
        GrammarFileError: with every finding, not only the first.
    """
    grammar = _collect(source, with_imports(source, read(source)))
    findings = tuple(islice(_findings(grammar), MAX_FINDINGS))
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


def _collect(source: Source, items: tuple[Item, ...]) -> Grammar:
    return Grammar(
        source,
        rules=tuple(item for item in items if isinstance(item, Rule)),
        declares=tuple(item for item in items if isinstance(item, Declare)),
        foralls=tuple(item for item in items if isinstance(item, ForAll)),
        uniques=tuple(item for item in items if isinstance(item, Unique)),
        limits=tuple(item for item in items if isinstance(item, Limit)),
    )


def _findings(grammar: Grammar) -> Iterator[Diagnostic]:
    yield from _rule_findings(grammar)
    yield from _directive_findings(grammar)
    for rule in grammar.rules:
        for reference, is_argument in references(rule.alternatives):
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
                "G201", f"undefined rule `{directive.scope}`", directive.span, _near(directive.scope, names)
            )
    yield from _declaration_findings(grammar)
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


def _near(name: str, names: tuple[str, ...]) -> str:
    """Similar names; not looked for among very many, as that takes long."""
    return did_you_mean(name, names) if len(names) <= MAX_NAMES else "add the rule, or correct its name"


def _declaration_findings(grammar: Grammar) -> Iterator[Diagnostic]:
    for declare in grammar.declares:
        for name in declare.names:
            if name not in KINDS:
                span = declare.span.word(name)
                yield Diagnostic("G214", f"unknown kind of leaf `{name}`", span, did_you_mean(name, KINDS))
    for forall in grammar.foralls:
        if forall.domain != "GROUP":
            message = f"a variable ranges over GROUP, not over `{forall.domain}`"
            yield Diagnostic("G216", message, forall.span.word(forall.domain), "write `in GROUP`")
        for name in forall.variables:
            if name in grammar.rule_names:
                message = f"`{name}` is both a variable and a rule"
                yield Diagnostic("G213", message, forall.span.word(name), "rename one of them")


def _reference_findings(
    grammar: Grammar, rule: Rule, reference: Reference, *, is_argument: bool
) -> Iterator[Diagnostic]:
    name, span = reference.name, reference.span
    if name in rule.parameters or name in grammar.variables:
        if reference.arguments:
            yield Diagnostic("G206", f"`{name}` takes no parameters", span, f"write `{name}`")
        return
    if name[0].isupper():
        yield from _terminal_findings(grammar, reference)
        return
    target = grammar.by_name.get(name)
    if target is None:
        if not is_argument or reference.arguments:  # an argument may name a group, which only a domain knows
            help_ = _near(name, grammar.rule_names)
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
    elif len(reference.arguments) > 1:
        help_ = f"write `{reference.name}` or `{reference.name}{{g}}`"
        yield Diagnostic("G206", f"terminal `{reference.name}` takes one group at most", reference.span, help_)
