"""What of a grammar and a vocabulary ends up in words, and why the rest does not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

from attrs import frozen

from grammarbt.bt.notation import Token, format_leaf
from grammarbt.bt.vocabulary import Group, actions_of, conditions_of
from grammarbt.grammar.bind import ending
from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.diagnostics import Diagnostic
from grammarbt.grammar.grouping import grouped
from grammarbt.grammar.needs import EntangledError, Needs
from grammarbt.grammar.reach import reachable
from grammarbt.grammar.symbols import Nonterminal, PlainProduction
from grammarbt.grammar.table import Production
from grammarbt.grammar.vectors import Vector

MAX_SHOWN = 6


@frozen(slots=False, eq=False)  # slots=False: cached_property keeps its value in the instance's dict
class Usage:
    """A bound grammar next to its productions as written out.

    Attributes:
        bound: the grammar.
        written: all productions, also those that cannot end with the domain's leaves.
        productive: those that can, in the order of `bound.productions`.
    """

    bound: BoundGrammar
    written: Sequence[PlainProduction]
    productive: Sequence[PlainProduction]

    @cached_property
    def usable(self) -> tuple[Production, ...]:
        """Productions that some derivation may take, as far as their own needs say."""
        allows, is_nonterminal = self.bound.forms.needs.allows, self.bound.is_nonterminal
        allowed = {lhs: [p for p in own if allows(p)] for lhs, own in self.bound.by_lhs.items()}
        parts = {lhs: [s for p in own for s in p.rhs if is_nonterminal(s)] for lhs, own in allowed.items()}
        return tuple(p for lhs in reachable(self.bound.start_symbol, parts.__getitem__) for p in allowed[lhs])

    def findings(self) -> Iterator[Diagnostic]:
        """Groups that cannot appear, leaves and rules that no word uses."""
        absent = [group for group in self.bound.vocabulary.groups if not self._appears(group)]
        for group in absent:
            yield self._absent_group(group)
        excused = {leaf for group in absent for leaf in (*actions_of(group), *conditions_of(group))}
        for leaf in self.bound.vocabulary.leaves:
            if leaf not in self._used_leaves and leaf not in excused:
                help_ = "add an alternative that uses it, or remove it from the vocabulary"
                yield Diagnostic("G408", f"no word uses {format_leaf(leaf)}", None, help_, severity="warning")
        yield from self._idle_rules()

    def _idle_rules(self) -> Iterator[Diagnostic]:
        used = {self.bound.rules[production.lhs - self.bound.start_symbol] for production in self.usable}
        met = {production.lhs.rule for production in self.written}
        for rule in self.bound.grammar.rules:
            if rule.name in met and rule.name not in used:
                message = f"no tree over this domain can use the rule `{rule.name}`"
                help_ = "loosen %unique or %limit, or give the domain more leaves"
                yield Diagnostic("G409", message, rule.span, help_, severity="warning")

    @cached_property
    def _chosen(self) -> dict[str, list[PlainProduction]]:
        """Per group, the productions in which a variable stands for it."""
        found: dict[str, list[PlainProduction]] = {}
        for production in self.written:
            for name in dict.fromkeys(name for _, name in production.choices):
                found.setdefault(name, []).append(production)
        return found

    @cached_property
    def _used_groups(self) -> set[str]:
        return {name for production in self.usable for _, name in self.productive[production.number].choices}

    @cached_property
    def _used_leaves(self) -> set[Token]:
        return {self.bound.terminals[s] for p in self.usable for s in p.rhs if not self.bound.is_nonterminal(s)}

    def _appears(self, group: Group) -> bool:
        if group.name in self._chosen:
            return group.name in self._used_groups
        leaves = {*actions_of(group), *conditions_of(group)}
        return not leaves or not leaves.isdisjoint(self._used_leaves)

    def _absent_group(self, group: Group) -> Diagnostic:
        message = f"group `{group.name}` cannot appear in any tree"
        chosen = self._chosen.get(group.name, [])
        stuck = next((s for p in chosen for s in p.rhs if isinstance(s, Nonterminal) and self._is_stuck(s)), None)
        if stuck is None:
            help_ = "use its leaves in a rule, or let a variable of %forall range over the groups"
            return Diagnostic("G407", message, None, help_, severity="warning")
        own = [p for p in self.written if p.lhs == stuck]
        reasons = list(dict.fromkeys(self._reason(production) for production in own))[:MAX_SHOWN]
        span = next((rule.span for rule in self.bound.grammar.rules if rule.name == stuck.rule), own[0].span)
        return Diagnostic("G407", message, span, _repair(group, stuck), tuple(reasons), severity="warning")

    @cached_property
    def _numbers(self) -> dict[Nonterminal, int]:
        return {
            plain.lhs: production.lhs for plain, production in zip(self.productive, self.bound.productions, strict=True)
        }

    def _is_stuck(self, nonterminal: Nonterminal) -> bool:
        number = self._numbers.get(nonterminal)
        return number is None or not self.bound.forms.needs.of(number)

    @cached_property
    def _ending(self) -> set[Nonterminal]:
        return ending(self.written)

    def _reason(self, production: PlainProduction) -> str:
        """Why an alternative is of no use."""
        shown = f"`{production.span.text}`"
        for symbol in production.rhs:
            if isinstance(symbol, Nonterminal) and symbol not in self._ending:
                return f"{shown} needs {self._empty_set(symbol)}, and there is none"
        lacking = self._lacking(production)
        return f"{shown} needs {lacking}" if lacking else f"{shown} does not fit into the limits"

    def _empty_set(self, nonterminal: Nonterminal) -> str:
        """The set without leaves that keeps a nonterminal from ending."""
        by_lhs = grouped(self.written, lambda production: production.lhs)

        def endless(lhs: Nonterminal) -> Iterator[Nonterminal]:
            rows = (production.rhs for production in by_lhs.get(lhs, ()))
            return (s for row in rows for s in row if isinstance(s, Nonterminal) and s not in self._ending)

        return next((lhs.name for lhs in reachable(nonterminal, endless) if lhs not in by_lhs), nonterminal.name)

    @cached_property
    def _unlimited(self) -> Needs | None:
        try:
            return Needs(self.bound, unlimited=True)
        except EntangledError:
            return None

    def _lacking(self, production: PlainProduction) -> str:
        """What the alternative needs more of than there is."""
        number = next((at for at, plain in enumerate(self.productive) if plain == production), None)
        if number is None or self._unlimited is None:
            return ""
        vectors = self._unlimited.demands(self.bound.productions[number])
        return next((text for vector in vectors if (text := self._shortage(vector))), "")

    def _shortage(self, vector: Vector) -> str:
        for at, amount in vector:
            dimension = self.bound.costs.dimensions[at]
            if amount > dimension.capacity:
                if not dimension.mask:
                    return f"{amount} nodes, and {dimension.capacity} are allowed"
                items = self._items(dimension.constraint, dimension.mask)
                return f"{amount} different leaves out of {', '.join(items)}" if items else f"{amount} groups"
        return ""

    def _items(self, constraint: int, mask: int) -> list[str]:
        """The leaves whose bits are in a mask."""
        single = [production for production in self.bound.productions if len(production.rhs) == 1]
        return [self.bound.symbol_text(p.rhs[0]) for p in single if p.use[constraint] & mask]


def _repair(group: Group, stuck: Nonterminal) -> str:
    if not group.actions:
        return "give the group an action"
    return f'let an action stand alone: add `| "→" "(" ACTION{{g}} ")"` to `{stuck.rule or stuck.name}`'
