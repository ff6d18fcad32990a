"""Lists inside derivations: rows of items, which an author writes as `x+` or as a rule that ends or begins with itself.

An item of its own before such a row, as in `x x+`, or behind one that begins with itself, belongs to the row.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TypeAlias

from attrs import evolve, frozen

from grammarbt.grammar import BoundGrammar
from grammarbt.search.derivations import Template
from grammarbt.search.derivationtree import DerivationTree

Shape: TypeAlias = tuple[int, ...]
"""The symbols that an item brings."""


@frozen
class Item:
    """An element of a row: its symbols, and the derivations of the nonterminals among them, one after the other."""

    shape: Shape
    content: Template


@frozen
class Row:
    """A list in a derivation tree.

    Attributes:
        node: where it begins.
        end: the node behind it.
        symbol: its nonterminal.
        items: left to right.
        starts: per item, the node where its content begins.
        own: the nonterminal of the item of its own at the outer end, if there is one.
    """

    node: int
    end: int
    symbol: int
    items: tuple[Item, ...]
    starts: tuple[int, ...]
    own: int | None = None

    def holds(self, item: int, node: int) -> bool:
        """Whether a node lies inside an item."""
        return self.starts[item] <= node < self.starts[item] + len(self.items[item].content)


@frozen
class _Kind:
    """How a recursive nonterminal writes its items: by shape, the production for an item among others, and alone."""

    right: bool
    among: dict[Shape, int]
    alone: dict[Shape, int]


class Rows:
    """Reads the rows of derivation trees, and writes them.

    A nonterminal is one of rows when each of its productions has itself at the end at most, or each at the beginning.

    Args:
        grammar: the language.
    """

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self._kinds = {symbol: kind for symbol in grammar.by_lhs if (kind := _kind(grammar, symbol))}
        self._shapes = {
            production.number: _shape(self._kinds[production.lhs], production.lhs, production.rhs)
            for production in grammar.productions
            if production.lhs in self._kinds
        }
        self._beside: dict[int | None, int] = {
            production.number: at
            for production in grammar.productions
            if production.lhs not in self._kinds
            and (at := _beside(self._kinds, grammar.parts[production.number], production.rhs)) is not None
        }
        self._open = {
            shape: Item(shape, tuple(None for symbol in shape if grammar.is_nonterminal(symbol)))
            for shape, _ in self._shapes.values()
        }
        self.items = {
            symbol: tuple(self._open[shape] for shape in dict.fromkeys((*kind.among, *kind.alone)))
            for symbol, kind in self._kinds.items()
        }

    def of(self, tree: DerivationTree) -> list[Row]:
        """Every row of a derivation tree, the outer before the inner."""
        found: list[Row] = []
        inside: set[int] = set()
        for node, symbol in enumerate(tree.symbols):
            if symbol in self._kinds and node not in inside:
                found.append(self._read(tree, node, inside))
            elif (at := self._beside.get(tree.steps[node])) is not None:
                first, second = list(tree.children(node))[at : at + 2]
                found.append(self._read_beside(tree, first, second, inside))
        return found

    def _read_beside(self, tree: DerivationTree, first: int, second: int, inside: set[int]) -> Row:
        """The row of two neighbours, an item of its own and a row."""
        leads = tree.symbols[second] in self._kinds
        node, alone = (second, first) if leads else (first, second)
        row, item = self._read(tree, node, inside), Item((tree.symbols[alone],), tree.below(alone))
        items = (item, *row.items) if leads else (*row.items, item)
        starts = (alone, *row.starts) if leads else (*row.starts, alone)
        return evolve(row, node=first, end=tree.ends[second], items=items, starts=starts, own=item.shape[0])

    def _read(self, tree: DerivationTree, node: int, inside: set[int]) -> Row:
        symbol = tree.symbols[node]
        right = self._kinds[symbol].right
        items: list[Item] = []
        starts: list[int] = []
        at = node
        while True:
            inside.add(at)
            shape, goes_on = self._shapes[tree.steps[at] or 0]
            begin, end, below = at + 1, tree.ends[at], at
            if goes_on:
                below = self._last(tree, at) if right else at + 1
                begin, end = (begin, below) if right else (tree.ends[below], end)
            items.append(Item(shape, tree.steps[begin:end]))
            starts.append(begin)
            if not goes_on:
                order = 1 if right else -1
                return Row(node, tree.ends[node], symbol, tuple(items[::order]), tuple(starts[::order]))
            at = below

    def _last(self, tree: DerivationTree, node: int) -> int:
        for child in tree.children(node):
            last = child
        return last

    def admits(self, symbol: int, item: Item) -> bool:
        """Whether rows of a nonterminal may hold such an item."""
        kind = self._kinds[symbol]
        return item.shape in kind.among or item.shape in kind.alone

    def written(self, row: Row, items: Sequence[Item]) -> Template | None:
        """The derivation of a row with these items instead of its own; None if there is no such row."""
        right = self._kinds[row.symbol].right
        if row.own is None or not items:
            return self._written(row.symbol, items)
        alone, others = (items[0], items[1:]) if right else (items[-1], items[:-1])
        rest = self._written(row.symbol, others) if alone.shape == (row.own,) else None
        return None if rest is None else (*alone.content, *rest) if right else (*rest, *alone.content)

    def _written(self, symbol: int, items: Sequence[Item]) -> Template | None:
        kind = self._kinds[symbol]
        last, others = (items[-1:], items[:-1]) if kind.right else (items[:1], items[1:])
        if not items or last[0].shape not in kind.alone or any(item.shape not in kind.among for item in others):
            return None
        end = (kind.alone[last[0].shape], *last[0].content)
        if kind.right:
            return (*(step for item in others for step in (kind.among[item.shape], *item.content)), *end)
        steps = (kind.among[item.shape] for item in reversed(others))
        return (*steps, *end, *(step for item in others for step in item.content))


def _kind(grammar: BoundGrammar, symbol: int) -> _Kind | None:
    """How a nonterminal writes rows; None if it does not."""
    rules = [(production.number, production.rhs) for production in grammar.by_lhs[symbol]]
    own = [rhs for _, rhs in rules if symbol in rhs]
    for right, place in ((True, -1), (False, 0)):
        if own and all(rhs.count(symbol) == 1 and rhs[place] == symbol and len(rhs) > 1 for rhs in own):
            among = {(rhs[:-1] if right else rhs[1:]): number for number, rhs in rules if symbol in rhs}
            alone = {rhs: number for number, rhs in rules if symbol not in rhs}
            return _Kind(right, among, alone)
    return None


def _beside(kinds: dict[int, _Kind], parts: Shape, rhs: Shape) -> int | None:
    """Where, among the parts of a production, an item stands beside a row that it could belong to; None if nowhere."""
    for at, (first, second) in enumerate(pairwise(parts)):
        row, alone, right = (second, first, True) if second in kinds else (first, second, False)
        kind = kinds.get(row)
        if (
            kind
            and alone not in kinds
            and kind.right == right
            and (alone,) in kind.among
            and (first, second) in pairwise(rhs)
        ):
            return at
    return None


def _shape(kind: _Kind, symbol: int, rhs: Shape) -> tuple[Shape, bool]:
    """The item that a production brings, and whether the row goes on behind it."""
    if symbol not in rhs:
        return rhs, False
    return (rhs[:-1] if kind.right else rhs[1:]), True
