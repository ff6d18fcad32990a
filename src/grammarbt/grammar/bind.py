"""Binding, second half: check the written-out productions, number them, and drop what cannot be finished."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import networkx as nx
from attrs import evolve

from grammarbt.bt.notation import Token
from grammarbt.bt.vocabulary import Vocabulary
from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.constraints import Costs, compile_costs
from grammarbt.grammar.diagnostics import Diagnostic, GrammarFileError
from grammarbt.grammar.expand import expand
from grammarbt.grammar.grouping import grouped
from grammarbt.grammar.model import KINDS, START, Grammar
from grammarbt.grammar.reach import reachable
from grammarbt.grammar.shape import levels, operators, shape_findings
from grammarbt.grammar.symbols import Nonterminal, PlainProduction
from grammarbt.grammar.syntax import Limit, Unique
from grammarbt.grammar.table import Production, enclosing


def bind(grammar: Grammar, vocabulary: Vocabulary) -> BoundGrammar:
    """The language of a grammar over a vocabulary.

    Raises:
        GrammarFileError: names the domain does not have, words that are not trees, rules that never end, constraints
            that leave nothing.
    """
    return bind_written(grammar, vocabulary, write_out(grammar, vocabulary))


def bind_written(grammar: Grammar, vocabulary: Vocabulary, written: Sequence[PlainProduction]) -> BoundGrammar:
    """The second half of `bind`, for whoever wants to look at the productions too."""
    productive = productive_of(written)
    _raise(shape_findings(productive))
    _raise(_cycles(productive))
    bound = _number(grammar, vocabulary, productive)
    return _finishable(bound)


def write_out(grammar: Grammar, vocabulary: Vocabulary) -> tuple[PlainProduction, ...]:
    """Every production of the grammar over the vocabulary, when each rule can end with some vocabulary.

    Raises:
        GrammarFileError: names the domain does not have, rules that never end.
    """
    if not vocabulary.leaves:
        help_ = "give the domain's vocabulary a group with an action"
        raise GrammarFileError([Diagnostic("G403", "the domain has no leaves", None, help_)])
    written = expand(grammar, vocabulary)
    _raise(_unproductive(grammar, written))
    return written


def _raise(findings: Iterable[Diagnostic]) -> None:
    found = tuple(findings)
    if found:
        raise GrammarFileError(found)


def ending(productions: Sequence[PlainProduction], *, ignore_empty_sets: bool = False) -> set[Nonterminal]:
    """Nonterminals from which some row of terminals can be reached."""
    own = {production.lhs for production in productions}
    users: dict[Nonterminal, list[int]] = {}
    missing = []
    found: dict[Nonterminal, None] = {}
    for at, production in enumerate(productions):
        parts = dict.fromkeys(symbol for symbol in production.rhs if isinstance(symbol, Nonterminal))
        if ignore_empty_sets:
            parts = {part: None for part in parts if part in own}
        missing.append(len(parts))
        for part in parts:
            users.setdefault(part, []).append(at)
        if not parts:
            found[production.lhs] = None
    queue = list(found)
    while queue:
        for at in users.get(queue.pop(), ()):
            missing[at] -= 1
            lhs = productions[at].lhs
            if not missing[at] and lhs not in found:
                found[lhs] = None
                queue.append(lhs)
    return set(found)


def _ends(symbol: object, ends: set[Nonterminal]) -> bool:
    return not isinstance(symbol, Nonterminal) or symbol in ends


def _unproductive(grammar: Grammar, productions: Sequence[PlainProduction]) -> list[Diagnostic]:
    """Rules that can never end, whatever leaves a domain has."""
    ends = {nonterminal.rule for nonterminal in ending(productions, ignore_empty_sets=True)}
    used = {production.lhs.rule for production in productions}
    note = "every alternative uses a rule that never ends"
    help_ = 'add an alternative that ends, for example one with `ACTION` or a leaf such as "[stop]"'
    return [
        Diagnostic("G203", f"rule `{rule.name}` can never produce a finished tree", rule.span, help_, (note,))
        for rule in grammar.rules
        if rule.name in used and rule.name not in ends
    ]


def productive_of(productions: Sequence[PlainProduction]) -> tuple[PlainProduction, ...]:
    """What is left when sets of leaves that are empty for some group are taken into account, reachable only."""
    ends = ending(productions)
    kept = [p for p in productions if p.lhs in ends and all(_ends(s, ends) for s in p.rhs)]
    by_lhs = grouped(kept, lambda production: production.lhs)
    start = next((production.lhs for production in productions if production.lhs.rule == START), None)
    if start is None or start not in by_lhs:
        message = "the domain has no leaves where this grammar needs them"
        help_ = f"every tree needs a group with leaves for its {' or '.join(KINDS)}"
        raise GrammarFileError([Diagnostic("G404", message, None, help_)])
    parts = {lhs: [s for p in own for s in p.rhs if isinstance(s, Nonterminal)] for lhs, own in by_lhs.items()}
    reached = set(reachable(start, parts.__getitem__))
    return tuple(production for production in kept if production.lhs in reached)


def _cycles(productions: Sequence[PlainProduction]) -> list[Diagnostic]:
    """Rules that come back to themselves without adding anything: infinitely many derivations of one word."""
    empty: set[Nonterminal] = set()
    size = -1
    while len(empty) > size:
        size = len(empty)
        empty |= {p.lhs for p in productions if all(symbol in empty for symbol in p.rhs)}
    graph: nx.DiGraph[Nonterminal] = nx.DiGraph()
    for production in productions:
        for at, symbol in enumerate(production.rhs):
            others = production.rhs[:at] + production.rhs[at + 1 :]
            if isinstance(symbol, Nonterminal) and all(other in empty for other in others):
                graph.add_edge(production.lhs, symbol, span=production.span)
    found = []
    for component in nx.strongly_connected_components(graph):
        first = min(component, key=lambda nonterminal: (nonterminal.name, nonterminal.rule))
        if len(component) > 1 or graph.has_edge(first, first):
            span = min((graph.edges[edge]["span"] for edge in graph.out_edges(first)), key=lambda s: (s.start, s.end))
            message = f"`{first.name}` comes back to itself without adding anything"
            found.append(Diagnostic("G205", message, span, "remove the alternative that closes the circle"))
    return sorted(found, key=lambda finding: finding.message)


def _number(grammar: Grammar, vocabulary: Vocabulary, productions: Sequence[PlainProduction]) -> BoundGrammar:
    start = next(production.lhs for production in productions if production.lhs.rule == START)
    nonterminals = list(dict.fromkeys([start, *(production.lhs for production in productions)]))
    terminals = _terminals(vocabulary, productions)
    number: dict[object, int] = {symbol: at for at, symbol in enumerate([*terminals, *nonterminals])}
    costs = compile_costs(grammar, productions)
    numbered = tuple(_numbered(at, production, number, costs) for at, production in enumerate(productions))
    opens = {number[n]: _opened(costs, n) for n in nonterminals}
    around = enclosing(numbered, opens, len(terminals))
    return BoundGrammar(
        grammar,
        vocabulary,
        tuple(terminals),
        tuple(nonterminal.name for nonterminal in nonterminals),
        tuple(nonterminal.rule for nonterminal in nonterminals),
        numbered,
        costs,
        tuple(opens[number[n]] for n in nonterminals),
        tuple(around.get(number[n], frozenset()) for n in nonterminals),
        _blocks(productions, number),
    )


def _terminals(vocabulary: Vocabulary, productions: Sequence[PlainProduction]) -> list[Token]:
    """Each once, as first met."""
    own: dict[Token, Token] = {
        leaf: leaf for leaf in vocabulary.leaves
    }  # the same leaf is found faster than an equal one
    met = [own.get(s, s) for production in productions for s in production.rhs if not isinstance(s, Nonterminal)]
    return list(dict.fromkeys(met))


def _numbered(at: int, production: PlainProduction, number: Mapping[object, int], costs: Costs) -> Production:
    """A production with numbers for its symbols, and what it uses of what is limited."""
    return Production(
        at,
        number[production.lhs],
        tuple(number[symbol] for symbol in production.rhs),
        levels(production),
        production.weight,
        production.alias,
        costs.use[at],
        tuple(sorted(constraint for own, constraint in costs.clash if own == at)),
    )


def _opened(costs: Costs, nonterminal: Nonterminal) -> tuple[int, ...]:
    return tuple(at for at, constraint in enumerate(costs.constraints) if constraint.rule == nonterminal.rule)


def _blocks(productions: Sequence[PlainProduction], number: dict[object, int]) -> tuple[int, ...]:
    """What a chosen group leads to: the sub-trees that searchers treat as units."""
    signs = operators(productions)
    found = [s for p in productions if p.choices for s in p.rhs if isinstance(s, Nonterminal) and s not in signs]
    return tuple(dict.fromkeys(number[symbol] for symbol in found))


def _finishable(bound: BoundGrammar) -> BoundGrammar:
    """Complain if no word satisfies the constraints; forget blocks that have none."""
    directives: tuple[Unique | Limit, ...] = (*bound.grammar.uniques, *bound.grammar.limits)
    span = directives[0].span if directives else None
    needs = bound.forms.needs
    if not needs.of(bound.start_symbol):
        code = "G405" if bound.grammar.limits and not bound.grammar.uniques else "G404"
        message = "the constraints leave no tree at all"
        _raise([Diagnostic(code, message, span, "loosen %unique or %limit, or give the domain more leaves")])
    return evolve(bound, blocks=tuple(block for block in bound.blocks if needs.of(block)))
