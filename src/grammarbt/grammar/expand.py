"""Binding, first half: write out templates, variables and repetitions for a vocabulary.

A variable of `%forall` is chosen in the alternative (of a rule, or in parentheses) that mentions it directly: the
alternative stands for one copy per group.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Mapping
from itertools import product
from typing import TypeAlias

from attrs import frozen

from grammarbt.bt.model import Action, Condition, Leaf
from grammarbt.bt.notation import Token, format_leaf, tokens
from grammarbt.bt.vocabulary import Group, Vocabulary, actions_of, conditions_of
from grammarbt.errors import NotationError, did_you_mean
from grammarbt.grammar.diagnostics import Diagnostic, GrammarFileError, Span
from grammarbt.grammar.model import START, Grammar
from grammarbt.grammar.symbols import Nonterminal, PlainProduction, Symbol
from grammarbt.grammar.syntax import (
    Alternative,
    Argument,
    Choice,
    Expression,
    Literal,
    Reference,
    Repeat,
    Rule,
    direct_references,
)

MAX_PRODUCTIONS = 10_000
MAX_SYMBOLS = 25_000


@frozen
class GroupValue:
    """A group, as the value of a variable or a template argument."""

    name: str


Value: TypeAlias = GroupValue | tuple[Symbol, ...]
Environment: TypeAlias = tuple[tuple[str, Value], ...]

_LEAVES: Mapping[str, Callable[[Group], tuple[Leaf, ...]]] = {"ACTION": actions_of, "CONDITION": conditions_of}


def expand(grammar: Grammar, vocabulary: Vocabulary) -> tuple[PlainProduction, ...]:
    """Every production that the start symbol can lead to, in the order met.

    Raises:
        GrammarFileError: unknown groups or leaves, strings that are not notation, templates that grow without end.
    """
    expander = _Expander(grammar, vocabulary)
    found = tuple(dict.fromkeys(expander.run()))
    if expander.findings:
        raise GrammarFileError(dict.fromkeys(expander.findings))
    return found


class _Expander:
    """Works through the nonterminals met so far; `queue` holds how to produce each one's alternatives."""

    def __init__(self, grammar: Grammar, vocabulary: Vocabulary) -> None:
        self.grammar = grammar
        self.rules = {rule.name: rule for rule in grammar.rules}
        self.groups = {group.name: group for group in vocabulary.groups}
        self.known_leaves = vocabulary.index
        self.findings: list[Diagnostic] = []
        self.met: set[Nonterminal] = set()
        self.queue: deque[tuple[Nonterminal, Callable[[Nonterminal], Iterator[PlainProduction]]]] = deque()

    def run(self) -> Iterator[PlainProduction]:
        count, size = 0, 0
        self.rule(self.rules[START], ())
        while self.queue:
            nonterminal, produce = self.queue.popleft()
            for production in produce(nonterminal):
                count, size = count + 1, size + len(production.rhs)
                if count > MAX_PRODUCTIONS or size > MAX_SYMBOLS:
                    message = f"written out, the grammar has more than {MAX_PRODUCTIONS:,} productions"
                    if count <= MAX_PRODUCTIONS:
                        message = f"written out, the grammar has more than {MAX_SYMBOLS:,} symbols"
                    help_ = "use fewer variables in one alternative, and no template that grows its own argument"
                    self.find("G208", message, production.span, help_)
                    return
                yield production

    def meet(
        self, nonterminal: Nonterminal, produce: Callable[[Nonterminal], Iterator[PlainProduction]]
    ) -> Nonterminal:
        if nonterminal not in self.met:
            self.met.add(nonterminal)
            self.queue.append((nonterminal, produce))
        return nonterminal

    def rule(self, rule: Rule, arguments: tuple[Value, ...]) -> Nonterminal:
        environment = tuple(zip(rule.parameters, arguments, strict=True))
        shown = f"{rule.name}{{{','.join(map(_show, arguments))}}}" if arguments else rule.name
        return self.meet(
            Nonterminal(_short(shown), rule.name, (rule.name, arguments)),
            lambda lhs: self.alternatives(lhs, rule.alternatives, environment),
        )

    def alternatives(
        self, lhs: Nonterminal, alternatives: tuple[Alternative, ...], environment: Environment
    ) -> Iterator[PlainProduction]:
        for alternative in alternatives:
            for chosen in self.choices(alternative, environment):
                here = (*environment, *((name, GroupValue(group)) for name, group in chosen))
                rhs = self.sequence(alternative.items, here)
                yield PlainProduction(lhs, rhs, chosen, alternative.weight, alternative.alias, alternative.span)

    def choices(self, alternative: Alternative, environment: Environment) -> Iterator[tuple[tuple[str, str], ...]]:
        bound = {name for name, _ in environment}
        names = (reference.name for reference, _ in direct_references(alternative))
        free = [name for name in dict.fromkeys(names) if name in self.grammar.variables and name not in bound]
        for groups in product(self.groups, repeat=len(free)):
            yield tuple(zip(free, groups, strict=True))

    def sequence(self, items: tuple[Expression, ...], environment: Environment) -> tuple[Symbol, ...]:
        return tuple(symbol for item in items for symbol in self.expression(item, environment))

    def expression(self, item: Expression, environment: Environment) -> tuple[Symbol, ...]:
        if isinstance(item, Literal):
            return self.literal(item)
        if isinstance(item, Reference):
            return self.reference(item, environment)
        key = (item, environment)
        if isinstance(item, Repeat):
            return (self.meet(Nonterminal(item.span.text, "", key), lambda lhs: self.repeat(lhs, item, environment)),)
        return (self.meet(Nonterminal(item.span.text, "", key), lambda lhs: self.choice(lhs, item, environment)),)

    def choice(self, lhs: Nonterminal, item: Choice, environment: Environment) -> Iterator[PlainProduction]:
        yield from self.alternatives(lhs, item.alternatives, environment)
        if item.optional:
            yield PlainProduction(lhs, (), (), 1.0, None, item.span)

    def repeat(self, lhs: Nonterminal, item: Repeat, environment: Environment) -> Iterator[PlainProduction]:
        """`x+` is `x x+ | x`, as the paper's s⁺; `x*` is `x x* | `; counted repetition is counted down."""
        inner = self.expression(item.item, environment)
        rest = (lhs,) if item.most is None else self.rest(item, environment)
        if item.most is None and item.least == 1:
            yield PlainProduction(lhs, (*inner, *rest), (), 1.0, None, item.span)
            yield PlainProduction(lhs, inner, (), 1.0, None, item.span)
            return
        yield PlainProduction(lhs, (*inner, *rest), (), 1.0, None, item.span)
        if item.least == 0:
            yield PlainProduction(lhs, (), (), 1.0, None, item.span)

    def rest(self, item: Repeat, environment: Environment) -> tuple[Symbol, ...]:
        most = (item.most or 0) - 1
        if most == 0:
            return ()
        return self.expression(Repeat(item.item, max(item.least - 1, 0), most, item.span), environment)

    def literal(self, item: Literal) -> tuple[Token, ...]:
        try:
            found = tokens(item.text)
        except NotationError as error:
            self.find("G105", f"this string is not notation: {error.message}", item.span, error.hint or "")
            return ()
        for token in found:
            if isinstance(token, Action | Condition) and token not in self.known_leaves:
                known = map(format_leaf, self.known_leaves)
                help_ = did_you_mean(format_leaf(token), known)
                self.find("G402", f"the domain has no leaf {format_leaf(token)}", item.span, help_)
        return found

    def reference(self, item: Reference, environment: Environment) -> tuple[Symbol, ...]:
        values = dict(environment)
        if item.name in values:
            value = values[item.name]
            if isinstance(value, GroupValue):
                help_ = f"a group stands between braces, as in `ACTION{{{item.name}}}`"
                self.find("G215", f"`{item.name}` is a group, not a part of a tree", item.span, help_)
                return ()
            return value
        if item.name[0].isupper():
            return (self.leaf_set(item, environment),)
        rule = self.rules[item.name]
        return (self.rule(rule, tuple(self.argument(part, environment) for part in item.arguments)),)

    def argument(self, item: Argument, environment: Environment) -> Value:
        if isinstance(item, Reference) and not item.arguments:
            value = dict(environment).get(item.name)
            if value is not None:
                return value
            if item.name not in self.rules and not item.name[0].isupper():
                return self.group(item.name, item.span)
        if isinstance(item, Literal) and item.text in self.groups:
            return GroupValue(item.text)
        return self.expression(item, environment)

    def group(self, name: str, span: Span) -> GroupValue:
        if name not in self.groups:
            help_ = did_you_mean(name, [*self.groups, *self.rules])
            self.find("G401", f"`{name}` is neither a group of the domain nor a rule", span, help_)
        return GroupValue(name)

    def set_argument(self, item: Argument, environment: Environment) -> Value:
        """A group; one whose name is not a word stands in quotes."""
        return self.group(item.text, item.span) if isinstance(item, Literal) else self.argument(item, environment)

    def leaf_set(self, item: Reference, environment: Environment) -> Nonterminal:
        value = self.set_argument(item.arguments[0], environment) if item.arguments else None
        if value is not None and not isinstance(value, GroupValue):
            self.find("G206", f"`{item.name}` takes a group", item.span, f"write `{item.name}{{g}}`")
            value = None
        groups = [self.groups[value.name]] if value and value.name in self.groups else list(self.groups.values())
        shown = f"{item.name}{{{value.name}}}" if value else item.name

        def produce(lhs: Nonterminal) -> Iterator[PlainProduction]:
            for leaf in dict.fromkeys(leaf for group in groups for leaf in _LEAVES[item.name](group)):
                yield PlainProduction(lhs, (leaf,), (), 1.0, None, item.span)

        return self.meet(Nonterminal(shown, "", (item.name, value)), produce)

    def find(self, code: str, message: str, span: Span, help_: str) -> None:
        self.findings.append(Diagnostic(code, message, span, help_))


def _show(value: Value) -> str:
    if isinstance(value, GroupValue):
        return value.name
    return " ".join(part.name if isinstance(part, Nonterminal) else _sign(part) for part in value)


def _sign(token: Token) -> str:
    return format_leaf(token) if isinstance(token, Action | Condition) else token.sign


def _short(name: str, most: int = 60) -> str:
    return name if len(name) <= most else f"{name[: most - 1]}…"
