"""Everything that can be said about a grammar without deriving much: the findings of `grammarbt grammar check`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from attrs import asdict, frozen

from grammarbt.bt.model import Action, Condition
from grammarbt.bt.notation import format_tree, tokens
from grammarbt.bt.vocabulary import ActionType, ConditionType, Group, Vocabulary
from grammarbt.errors import NotationError
from grammarbt.grammar.ambiguity import Ambiguity, find_ambiguity, smallest_word
from grammarbt.grammar.bind import bind_written, productive_of, write_out
from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.diagnostics import Diagnostic, GrammarFileError, Source
from grammarbt.grammar.finite import is_finite
from grammarbt.grammar.model import START, Grammar, load_grammar
from grammarbt.grammar.reach import reachable
from grammarbt.grammar.symbols import PlainProduction
from grammarbt.grammar.syntax import literals, references
from grammarbt.grammar.usage import Usage

MAX_STEPS_SHOWN = 12
_ANY_GROUPS = ("g1", "g2", "g3")


@frozen
class Summary:
    """A bound grammar in figures.

    Attributes:
        groups: the names of the domain's groups.
        productions: how many, written out.
        finite: whether the language is.
        words: how many it has, or None if nobody counted them.
        smallest: a word with the fewest tokens, in notation, or None if it was not found within the limit.
        ambiguous: True, False, or None if the limited search found no word and did not see all.
    """

    groups: tuple[str, ...]
    productions: int
    finite: bool
    words: int | None
    smallest: str | None
    ambiguous: bool | None


@frozen
class Report:
    """The findings, errors first, and the summary of a grammar that was bound to a domain without an error."""

    findings: tuple[Diagnostic, ...]
    summary: Summary | None = None

    @property
    def errors(self) -> tuple[Diagnostic, ...]:
        """What keeps the grammar from being used."""
        return tuple(finding for finding in self.findings if finding.severity == "error")

    @property
    def warnings(self) -> tuple[Diagnostic, ...]:
        """What its author may not have meant."""
        return tuple(finding for finding in self.findings if finding.severity == "warning")

    def as_json(self) -> dict[str, Any]:
        """For editors: positions count from 1, the end is exclusive."""
        return {
            "ok": not self.errors,
            "diagnostics": [finding.as_json() for finding in self.findings],
            "summary": asdict(self.summary) if self.summary else None,
        }


Counter = Callable[[BoundGrammar], int | None]


def check_source(source: Source, vocabulary: Vocabulary | None = None, counter: Counter | None = None) -> Report:
    """`check` for a text that may not even be a grammar."""
    try:
        grammar = load_grammar(source)
    except GrammarFileError as error:
        return Report(error.diagnostics)
    return check(grammar, vocabulary, counter)


def check(grammar: Grammar, vocabulary: Vocabulary | None = None, counter: Counter | None = None) -> Report:
    """Every finding about a grammar.

    Args:
        grammar: as read.
        vocabulary: the domain's; without one, groups and leaves are made up that suit the grammar, and there is no
            summary.
        counter: counts the words of a finite language, or gives None.
    """
    findings = list(_static_findings(grammar))
    leaves = vocabulary or stand_in(grammar)
    try:
        written = write_out(grammar, leaves)
        bound = bind_written(grammar, leaves, written)
        return _bound_report(Usage(bound, written, productive_of(written)), findings, vocabulary is not None, counter)
    except GrammarFileError as error:
        return Report((*error.diagnostics, *findings))


def _bound_report(usage: Usage, findings: list[Diagnostic], full: bool, counter: Counter | None) -> Report:
    bound = usage.bound
    verdict = find_ambiguity(bound)
    if full:
        findings += usage.findings()
    if verdict.ambiguity:
        findings.append(_ambiguity_finding(bound, usage.productive, verdict.ambiguity))
    if not full:
        return Report(tuple(findings))
    finite, smallest = is_finite(bound, usage.usable), smallest_word(bound)
    summary = Summary(
        groups=tuple(group.name for group in bound.vocabulary.groups),
        productions=len(bound.productions),
        finite=finite,
        words=counter(bound) if counter and finite else None,
        smallest=None if smallest is None else format_tree(bound.tree_of(smallest)),
        ambiguous=True if verdict.ambiguity else (False if verdict.complete else None),
    )
    return Report(tuple(findings), summary)


def _static_findings(grammar: Grammar) -> Iterator[Diagnostic]:
    """What is written in the file itself and has no use."""
    used = _reachable(grammar)
    for rule in grammar.rules:
        if rule.name not in used and rule.span.source == grammar.source:
            help_ = "use it in a rule, or remove it"
            yield Diagnostic("G204", f"rule `{rule.name}` is never used", rule.span, help_, severity="warning")
    names = {reference.name for rule in grammar.rules for reference, _ in references(rule.alternatives)}
    declared = [(name, item.span) for item in grammar.declares for name in item.names]
    declared += [(name, item.span) for item in grammar.foralls for name in item.variables]
    for name, span in declared:
        if name not in names and span.source == grammar.source:
            message = f"`{name}` is declared and never used"
            place = span.word(name)
            yield Diagnostic("G210", message, place, "use it in a rule, or remove it", severity="warning")


def _reachable(grammar: Grammar) -> set[str]:
    rules = {rule.name: rule for rule in grammar.rules}
    used = {name: [own.name for own, _ in references(rule.alternatives)] for name, rule in rules.items()}
    return set(reachable(START, lambda name: filter(rules.__contains__, used[name])))


def _ambiguity_finding(bound: BoundGrammar, productive: Sequence[PlainProduction], ambiguity: Ambiguity) -> Diagnostic:
    pairs = zip(ambiguity.first, ambiguity.second, strict=False)
    fork = next(at for at, (one, other) in enumerate(pairs) if one != other)
    span = productive[ambiguity.second[fork]].span
    notes = (
        f"the word: {' '.join(map(bound.symbol_text, ambiguity.word))}",
        f"one way: {_steps(bound, ambiguity.first, fork)}",
        f"another: {_steps(bound, ambiguity.second, fork)}",
    )
    message = f"the grammar is ambiguous: a word of `{bound.nonterminal_name(ambiguity.symbol)}` has two derivations"
    help_ = "harmless for searching; counts of derivations then exceed counts of words"
    return Diagnostic("G501", message, span, help_, notes, "warning")


def _steps(bound: BoundGrammar, derivation: tuple[int, ...], fork: int) -> str:
    """The steps of a derivation, from where the two part."""
    shown = [bound.production_text(number) for number in derivation[fork : fork + MAX_STEPS_SHOWN]]
    return "; ".join([*(["…"] if fork else []), *shown, *(["…"] if len(derivation) > fork + MAX_STEPS_SHOWN else [])])


def stand_in(grammar: Grammar) -> Vocabulary:
    """A made-up vocabulary for a grammar: the groups and leaves that it names, each group with two of each kind."""
    hidden = {*grammar.rule_names, *grammar.variables}
    named = [
        reference.name
        for rule in grammar.rules
        for reference, argument in references(rule.alternatives)
        if argument and not reference.name[0].isupper() and reference.name not in {*hidden, *rule.parameters}
    ]
    groups = [_made_up(name) for name in dict.fromkeys(named or _ANY_GROUPS)]
    spelt = Group("leaves that the grammar spells out", *_spelt(grammar))
    return Vocabulary((*groups, spelt) if spelt.actions or spelt.conditions else tuple(groups))


def _made_up(name: str) -> Group:
    actions = tuple(ActionType(f"{name} action {number}") for number in (1, 2))
    return Group(name, actions, tuple(ConditionType(f"{name} condition {number}") for number in (1, 2)))


def _spelt(grammar: Grammar) -> tuple[tuple[ActionType, ...], tuple[ConditionType, ...]]:
    found: dict[Action | Condition, None] = {}
    for text in dict.fromkeys(literal.text for rule in grammar.rules for literal in literals(rule.alternatives)):
        try:
            found.update(dict.fromkeys(token for token in tokens(text) if isinstance(token, Action | Condition)))
        except NotationError:
            continue  # binding complains about it, with its place
    values = {leaf: tuple((key, (value,)) for key, value in leaf.arguments) for leaf in found}
    actions = tuple(ActionType(leaf.name, parameters=values[leaf]) for leaf in found if isinstance(leaf, Action))
    conditions = [ConditionType(leaf.name, parameters=values[leaf]) for leaf in found if isinstance(leaf, Condition)]
    return actions, tuple(conditions)
