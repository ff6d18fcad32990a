"""The language as an acyclic graph whose paths are its words, or its derivations, each exactly once.

Words come from determinizing the leftmost derivations (subset construction). A block that uses nothing of the
constraints around it – such as the sub-tree of a group – is one edge wherever its words cannot be mistaken for anything
else there; the graphs stay small, and everything that is counted or drawn from them is exact.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache, cached_property
from itertools import combinations
from typing import TypeAlias

import networkx as nx
from attrs import Factory, define

from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.leftmost import Move, Word
from grammarbt.grammar.paths import MAX_STEPS, Paths, explore, infinite, too_large
from grammarbt.grammar.table import Production
from grammarbt.grammar.vectors import NOTHING


class Language:
    """The graphs of a bound grammar, each built once, all within one budget of `MAX_STEPS`."""

    def __init__(self, bound: BoundGrammar) -> None:
        self.bound = bound
        self.words = cache(self._words)
        self.derivations = cache(self._derivations)
        self._apart = cache(self._no_common_word)
        self._steps = 0

    @cached_property
    def contained(self) -> frozenset[int]:
        """Blocks whose words are the same whatever stands around them."""
        return frozenset(block for block in self.bound.blocks if _is_contained(self.bound, block))

    @cached_property
    def endless(self) -> frozenset[int]:
        """Nonterminals that can come back to themselves at no cost: below them there is no largest tree."""
        return _endless(self.bound)

    def _words(self, symbol: int) -> Paths:
        """The distinct words of a nonterminal.

        Raises:
            InfiniteLanguageError: there are infinitely many.
            TooLargeError: the graph passes the limits.
        """
        subsets = _Subsets(self, self._units(symbol))
        return explore(subsets.start(symbol), subsets.edges)

    def _derivations(self, symbol: int) -> Paths:
        """The derivations of a nonterminal; raises as `words` does."""
        units, leftmost = self._units(symbol), self.bound.leftmost

        def edges(state: SententialForm) -> tuple[bool, list[tuple[int, SententialForm]]]:
            block = self.first_block(state, units)
            if block is not None:
                return False, [(~block, leftmost.split(without_first(state, block))[1])]
            moves = self.moves(state)
            return not moves, [(move.production, move.after) for move in moves]

        return explore(self.bound.start(symbol), edges)

    def _units(self, symbol: int) -> frozenset[int]:
        return self.contained if symbol == self.bound.start_symbol else frozenset()

    def first_block(self, state: SententialForm, units: frozenset[int]) -> int | None:
        """The block that is derived next in a state, if it is one of the given ones."""
        first = next((symbol for symbol in state.symbols if symbol >= self.bound.start_symbol), None)
        return first if first in units else None

    def moves(self, state: SententialForm) -> tuple[Move, ...]:
        """The state's moves, if the budget lasts and they do not lead to infinitely many words."""
        first = next((symbol for symbol in state.symbols if symbol >= self.bound.start_symbol), None)
        if first in self.endless:
            raise infinite()
        found = self.bound.leftmost.moves(state)
        self._steps += len(found)
        if self._steps > MAX_STEPS:
            raise too_large()
        return found

    def unmistakable(self, blocks: Sequence[int], terminals: Iterable[int]) -> bool:
        """Whether, where one of the blocks or terminals comes next, a word itself tells which."""
        graphs = [self.words(block) for block in blocks]
        heads = {label for graph in graphs for label, _ in graph.edges[0]}
        return (
            all(_is_prefix_free(graph) for graph in graphs)
            and heads.isdisjoint(terminals)
            and all(self._apart(one, other) for one, other in combinations(blocks, 2))
        )

    def _no_common_word(self, one: int, other: int) -> bool:
        first, second = self.words(one), self.words(other)
        stack, seen = [(0, 0)], {(0, 0)}
        while stack:
            left, right = stack.pop()
            if first.final[left] and second.final[right]:
                return False
            after = dict(second.edges[right])
            pairs = [(to, after[label]) for label, to in first.edges[left] if label in after]
            stack += [pair for pair in pairs if pair not in seen]
            seen.update(pairs)
        return True


_Item: TypeAlias = tuple[Word, SententialForm]
_Subset: TypeAlias = tuple[_Item, ...]


@define
class _Next:
    """What may come next at a node: a terminal, a block, or the end."""

    terminals: dict[int, set[_Item]] = Factory(dict)
    blocks: dict[int, set[_Item]] = Factory(dict)
    end: bool = False


class _Subsets:
    """Subset construction; an item is a row of terminals still to be spelled, and the state after them."""

    def __init__(self, language: Language, units: frozenset[int]) -> None:
        self.language, self.units = language, units
        self.leftmost = language.bound.leftmost

    def start(self, symbol: int) -> _Subset:
        return (((), self.language.bound.start(symbol)),)

    def edges(self, subset: _Subset) -> tuple[bool, list[tuple[int, _Subset]]]:
        after = self.closure(subset, self.units)
        if after.blocks and not self.language.unmistakable(sorted(after.blocks), after.terminals):
            after = self.closure(subset, frozenset())
        own = [(terminal, items) for terminal, items in after.terminals.items()]
        own += [(~block, items) for block, items in after.blocks.items()]
        return after.end, [(label, tuple(sorted(items, key=_by_number))) for label, items in sorted(own, key=_label)]

    def closure(self, subset: _Subset, units: frozenset[int]) -> _Next:
        found, stack, seen = _Next(), list(subset), set(subset)
        while stack:
            pending, state = stack.pop()
            block = self.language.first_block(state, units)
            if pending:
                found.terminals.setdefault(pending[0], set()).add((pending[1:], state))
            elif block is not None:
                found.blocks.setdefault(block, set()).add(self.leftmost.split(without_first(state, block)))
            else:
                found.end |= not state.symbols
                for move in self.language.moves(state):
                    item = (move.emits, move.after)
                    if item not in seen:
                        seen.add(item)
                        stack.append(item)
        return found


def _label(pair: tuple[int, set[_Item]]) -> int:
    return pair[0]


def _by_number(item: _Item) -> tuple[object, ...]:
    return item[0], item[1].symbols, item[1].used


def without_first(state: SententialForm, symbol: int) -> SententialForm:
    """The state after its first nonterminal has been derived without touching any open scope."""
    at = state.symbols.index(symbol)
    return SententialForm((*state.symbols[:at], *state.symbols[at + 1 :]), state.used)


def _is_prefix_free(graph: Paths) -> bool:
    return not any(end and own for end, own in zip(graph.final, graph.edges, strict=True))


def _reached(bound: BoundGrammar, symbol: int) -> list[Production]:
    met, queue, found = {symbol}, [symbol], []
    while queue:
        for production in bound.by_lhs.get(queue.pop(), ()):
            found.append(production)
            new = [s for s in dict.fromkeys(production.rhs) if bound.is_nonterminal(s) and s not in met]
            met.update(new)
            queue += new
    return found


def _is_contained(bound: BoundGrammar, block: int) -> bool:
    around = bound.encloses_of(block)
    return around.isdisjoint(bound.depth_constraints) and not any(
        production.use[at] for production in _reached(bound, block) for at in around
    )


def _endless(bound: BoundGrammar) -> frozenset[int]:
    """Nonterminals on a circle of productions that use up nothing of what is limited around them."""
    graph: nx.DiGraph[int] = nx.DiGraph()
    for production in bound.productions:
        scopes = {*bound.encloses_of(production.lhs), *bound.opens_of(production.lhs)}
        sized = any(bound.costs.constraints[at].kind != "unique" for at in scopes)
        if sized or any(production.use[at] for at in scopes):
            continue
        costly = [s for s in production.rhs if bound.is_nonterminal(s) and bound.forms.needs.of(s) != NOTHING]
        for symbol in production.rhs:
            if bound.is_nonterminal(symbol) and all(other == symbol for other in costly) and costly.count(symbol) <= 1:
                graph.add_edge(production.lhs, symbol)
    circles = nx.strongly_connected_components(graph)
    return frozenset(node for circle in circles for node in circle if len(circle) > 1 or graph.has_edge(node, node))
