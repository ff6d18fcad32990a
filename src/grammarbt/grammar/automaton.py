"""The language as an acyclic graph whose paths are its words, or its derivations, each exactly once.

Words come from determinizing the leftmost derivations (subset construction). A block that uses nothing of the
constraints around it – such as the sub-tree of a group – is one edge wherever its words cannot be mistaken for anything
else there; the graphs stay small, and everything that is counted or drawn from them is exact.

For counting, nodes that differ only by swapping leaves that the grammar cannot tell apart are one node: such a graph has
as many paths as there are words, but does not spell them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cache, cached_property, partial
from itertools import combinations
from typing import TypeAlias

from attrs import Factory, define

from grammarbt.bt.model import Action, Condition
from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.finite import endless, ever_open
from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.leftmost import Move
from grammarbt.grammar.paths import MAX_STEPS, Paths, explore, infinite, too_large
from grammarbt.grammar.reach import reachable
from grammarbt.grammar.symmetry import Item, Symmetry, by_number
from grammarbt.grammar.table import Production

_Subset: TypeAlias = tuple[Item, ...]
_NodeOf: TypeAlias = Callable[[Iterable[Item]], _Subset]


class Language:
    """The graphs of a bound grammar, each built once, all within one budget of `MAX_STEPS`."""

    def __init__(self, bound: BoundGrammar) -> None:
        self.bound = bound
        self.words = cache(partial(self._words, self._same))
        self.derivations = cache(partial(self._derivations, self._same))
        self.words_to_count = cache(partial(self._words, self._merged))
        self.derivations_to_count = cache(partial(self._derivations, self._merged))
        self._apart = cache(self._no_common_word)
        self._steps = 0

    @cached_property
    def contained(self) -> frozenset[int]:
        """Blocks whose words are the same whatever stands around them."""
        return frozenset(block for block in self.bound.blocks if _is_contained(self.bound, block))

    @cached_property
    def endless(self) -> frozenset[int]:
        """Nonterminals that can come back to themselves at no cost: below them there is no largest tree."""
        return endless(self.bound, self.bound.productions, ever_open(self.bound))

    @cached_property
    def symmetry(self) -> Symmetry:
        """Which leaves may be swapped."""
        return Symmetry(self.bound)

    def _words(self, node_of: _NodeOf, symbol: int) -> Paths:
        """The distinct words of a nonterminal.

        Raises:
            InfiniteLanguageError: there are infinitely many.
            TooLargeError: the graph passes the limits.
        """
        subsets = _Subsets(self, self._units(symbol))

        def edges(subset: _Subset) -> tuple[bool, list[tuple[int, _Subset]]]:
            end, after = subsets.after(subset)
            return end, [(label, node_of(items)) for label, items in after]

        return explore(self._same([((), self.bound.start(symbol))]), edges)

    def _derivations(self, node_of: _NodeOf, symbol: int) -> Paths:
        """The derivations of a nonterminal; raises as `_words` does."""
        units, leftmost = self._units(symbol), self.bound.leftmost

        def edges(node: _Subset) -> tuple[bool, list[tuple[int, _Subset]]]:
            ((_, state),) = node
            block = self.first_block(state, units)
            if block is not None:
                return False, [(~block, node_of([((), leftmost.split(without_first(state, block))[1])]))]
            moves = self.moves(state)
            return not moves, [(move.production, node_of([((), move.after)])) for move in moves]

        return explore(self._same([((), self.bound.start(symbol))]), edges)

    def _same(self, items: Iterable[Item]) -> _Subset:
        return tuple(sorted(items, key=by_number))

    def _merged(self, items: Iterable[Item]) -> _Subset:
        return self.symmetry.representative(items)

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
        graphs = [self.words_to_count(block) for block in blocks]
        heads = {label for graph in graphs for label, _ in graph.edges[0]}
        return (
            all(_is_prefix_free(graph) for graph in graphs)
            and heads.isdisjoint(terminals)
            and all(self._apart(one, other) for one, other in combinations(blocks, 2))
        )

    def _no_common_word(self, one: int, other: int) -> bool:
        if self._leaves(one).isdisjoint(self._leaves(other)):  # every tree has a leaf
            return not all(self.words_to_count(block).final[0] for block in (one, other))
        first, second = self.words(one), self.words(other)

        def after(pair: tuple[int, int]) -> list[tuple[int, int]]:
            follow = dict(second.edges[pair[1]])
            return [(to, follow[label]) for label, to in first.edges[pair[0]] if label in follow]

        return not any(first.final[left] and second.final[right] for left, right in reachable((0, 0), after))

    def _leaves(self, block: int) -> frozenset[int]:
        """The leaves that can come up in a block."""
        met = {symbol for production in _reached(self.bound, block) for symbol in production.rhs}
        return frozenset(
            s for s in met if s < self.bound.start_symbol and isinstance(self.bound.terminals[s], Action | Condition)
        )


@define
class _Next:
    """What may come next at a node: a terminal, a block, or the end."""

    terminals: dict[int, set[Item]] = Factory(dict)
    blocks: dict[int, set[Item]] = Factory(dict)
    end: bool = False


class _Subsets:
    """Subset construction; an item is a row of terminals still to be spelled, and the state after them."""

    def __init__(self, language: Language, units: frozenset[int]) -> None:
        self.language, self.units = language, units
        self.leftmost = language.bound.leftmost

    def after(self, subset: _Subset) -> tuple[bool, list[tuple[int, set[Item]]]]:
        """Whether a word may end here, and what follows each terminal or block that may come next."""
        found = self.closure(subset, self.units)
        if found.blocks and not self.language.unmistakable(sorted(found.blocks), found.terminals):
            found = self.closure(subset, frozenset())
        own = [*found.terminals.items(), *((~block, items) for block, items in found.blocks.items())]
        return found.end, sorted(own, key=_label)

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


def _label(pair: tuple[int, set[Item]]) -> int:
    return pair[0]


def without_first(state: SententialForm, symbol: int) -> SententialForm:
    """The state after its first nonterminal has been derived without touching any open scope."""
    at = state.symbols.index(symbol)
    return SententialForm((*state.symbols[:at], *state.symbols[at + 1 :]), state.used)


def _is_prefix_free(graph: Paths) -> bool:
    return not any(end and own for end, own in zip(graph.final, graph.edges, strict=True))


def _reached(bound: BoundGrammar, symbol: int) -> list[Production]:
    def parts(nonterminal: int) -> Iterator[int]:
        return (s for p in bound.by_lhs.get(nonterminal, ()) for s in p.rhs if bound.is_nonterminal(s))

    return [production for lhs in reachable(symbol, parts) for production in bound.by_lhs.get(lhs, ())]


def _is_contained(bound: BoundGrammar, block: int) -> bool:
    around = bound.encloses_of(block)
    return around.isdisjoint(bound.depth_constraints) and not any(
        production.use[at] for production in _reached(bound, block) for at in around
    )
