"""Small changes of any derivation: what a search around an incumbent tree tries, whatever the grammar.

Items of rows are inserted, deleted, replaced, moved, copied and spliced; sub-trees are derived again, exchanged, or
derived anew around what is there. Every change stays in the language, and short sub-trees come first.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from itertools import accumulate

import numpy as np

from grammarbt.grammar import BoundGrammar, Derivation
from grammarbt.search.derivations import Template
from grammarbt.search.moves import Moves, pick
from grammarbt.search.rows import Item, Row, Rows
from grammarbt.search.short import ShortFirst
from grammarbt.search.site import Edit, Site, below, row_of
from grammarbt.search.states import States

SHORTNESS = 0.7
LONGEST_SEGMENT = 3
NOVEL_DRAWS = 3
"""Further draws of a new sub-tree that brings nothing but what the derivation has already."""
FURTHER_EDIT = 0.35
MOST_EDITS = 4
ACROSS = 0.4
"""Chance that a moved item goes to another row."""
KEEP = 0.3
"""Chance that what is derived around a segment keeps its own items too."""


class Edits:
    """Random edits of derivations.

    Args:
        grammar: the language.
    """

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self.states = States(grammar)
        self.short = ShortFirst(self.states, SHORTNESS)
        self.rows = Rows(grammar)
        self._moves = Moves(grammar, self.states)
        self._varied = frozenset(lhs for lhs, own in grammar.by_lhs.items() if len(own) > 1)
        weighed: Mapping[Edit, float] = {
            self.insert: 3.0,
            self.delete: 1.5,
            self.replace: 1.5,
            self.move: 1.5,
            self.copy: 1.0,
            self.enclose: 1.5,
            self.splice: 0.7,
            self.convert: 0.7,
            self.regenerate: 2.0,
            self.exchange: 0.7,
        }
        self._edits = tuple(weighed)
        self._shares = list(accumulate(weighed.values()))

    def sample(self, rng: np.random.Generator) -> Derivation:
        """A random derivation of a tree, short ones first."""
        return self.short.complete((None,), rng) or ()

    def site(self, derivation: Template) -> Site:
        """A derivation, ready for edits."""
        tree = self._moves.tree(derivation)
        return Site(tree, self.rows.of(tree), frozenset(derivation))

    def neighbour(self, site: Site, others: Sequence[Site], rng: np.random.Generator) -> Derivation | None:
        """The derivation after one to four random edits, which may borrow from others; None if nothing changed."""
        first, found = site, None
        for _ in range(MOST_EDITS):
            edit = self._edits[bisect_right(self._shares, rng.random() * self._shares[-1])]
            derivation = self._edited(edit, site, pick([site, *others], rng), rng)
            further = rng.random() < FURTHER_EDIT
            if derivation is not None:
                found = derivation
                if further:
                    site = self.site(derivation)
            if not further:
                break
        return None if found == first.tree.steps else found

    def shorter(self, site: Site, rng: np.random.Generator) -> list[Derivation]:
        """Every derivation with an item less, or with an item's inner row in its place."""
        found: dict[Derivation, None] = {}
        for row in site.rows:
            for at in range(len(row.items)):
                inner = [other.items for other in site.rows if row.holds(at, other.node)]
                for items in ((), *inner):
                    kept = [item for item in items if self.rows.admits(row.symbol, item)]
                    template = self._spliced(site, row, (at, at + 1), kept)
                    derivation = self.short.complete(template, rng) if template else None
                    if derivation is not None and derivation != site.tree.steps:
                        found[derivation] = None
        return list(found)

    def _edited(self, edit: Edit, site: Site, other: Site, rng: np.random.Generator) -> Derivation | None:
        """Fill open places, rather by productions that the derivation does not have yet."""
        template = edit(site, other, rng)
        if template is None:
            return None
        found = self.short.complete(template, rng)
        for _ in range(NOVEL_DRAWS if None in template else 0):
            if found is None or not site.uses.issuperset(found):
                break
            found = self.short.complete(template, rng)
        return found

    # Rows

    def insert(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """A new item anywhere in a row."""
        gaps = [(row, at) for row in site.rows for at in range(len(row.items) + 1)]
        if not gaps:
            return None
        row, at = pick(gaps, rng)
        return self._opened(site, row, (at, at), rng)

    def _opened(self, site: Site, row: Row, cut: tuple[int, int], rng: np.random.Generator) -> Template | None:
        """The derivation with an item still to be derived in the place of some, of a kind that fits there."""
        found = [self._spliced(site, row, cut, (item,)) for item in self.rows.items[row.symbol]]
        fitting = [template for template in found if template is not None]
        return pick(fitting, rng) if fitting else None

    def copy(self, site: Site, other: Site, rng: np.random.Generator) -> Template | None:
        """An item of another derivation, anywhere in a row."""
        source, row = row_of(other, rng), row_of(site, rng)
        if source is None or row is None:
            return None
        at = below(len(row.items) + 1, rng)
        return self._spliced(site, row, (at, at), (pick(source.items, rng),))

    def _spliced(self, site: Site, row: Row, cut: tuple[int, int], items: Sequence[Item]) -> Template | None:
        """The derivation with items in the place of those from `cut[0]` to `cut[1]`, exclusive."""
        changed = [*row.items[: cut[0]], *items, *row.items[cut[1] :]]
        return site.rewritten(row, self.rows.written(row.symbol, changed))

    def delete(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """A row without one of its items."""
        row = row_of(site, rng)
        if row is None:
            return None
        at = below(len(row.items), rng)
        return self._spliced(site, row, (at, at + 1), ())

    def replace(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """A new item for an old one."""
        row = row_of(site, rng)
        if row is None:
            return None
        at = below(len(row.items), rng)
        return self._opened(site, row, (at, at + 1), rng)

    def splice(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """The items of a row inside an item, in the place of that item."""
        row = row_of(site, rng)
        if row is None:
            return None
        at = below(len(row.items), rng)
        inner = [other for other in site.rows if row.holds(at, other.node)]
        if not inner:
            return None
        kept = [item for item in pick(inner, rng).items if self.rows.admits(row.symbol, item)]
        return self._spliced(site, row, (at, at + 1), kept)

    def move(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """An item in another place of its row, or in another row."""
        row = row_of(site, rng)
        if row is None:
            return None
        left = list(row.items)
        item = left.pop(below(len(left), rng))
        if rng.random() < ACROSS:
            return self._moved_across(site, row, left, item, rng)
        left.insert(below(len(left) + 1, rng), item)
        return site.rewritten(row, self.rows.written(row.symbol, left))

    def _moved_across(
        self, site: Site, row: Row, left: Sequence[Item], item: Item, rng: np.random.Generator
    ) -> Template | None:
        ends = site.tree.ends
        others = [
            other
            for other in site.rows
            if (other.node >= ends[row.node] or row.node >= ends[other.node]) and self.rows.admits(other.symbol, item)
        ]
        if not others:
            return None
        other = pick(others, rng)
        at = below(len(other.items) + 1, rng)
        shorter = self.rows.written(row.symbol, left)
        longer = self.rows.written(other.symbol, [*other.items[:at], item, *other.items[at:]])
        if shorter is None or longer is None:
            return None
        (later, last), (earlier, first) = sorted([(row.node, shorter), (other.node, longer)], reverse=True)
        steps = site.tree.replaced(later, last)
        return (*steps[:earlier], *first, *steps[ends[earlier] :])

    # Sub-trees

    def regenerate(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """A sub-tree derived again, a small one rather than a large one."""
        tree = site.tree
        nodes = self._open_to_choice(site)
        bounds = list(accumulate(1.0 / (tree.ends[node] - node) for node in nodes))
        if not nodes:
            return None
        return tree.replaced(nodes[bisect_right(bounds, rng.random() * bounds[-1], hi=len(nodes) - 1)], (None,))

    def exchange(self, site: Site, other: Site, rng: np.random.Generator) -> Template | None:
        """A sub-tree of the other in the place of one from the same nonterminal."""
        nodes = self._open_to_choice(site)
        if not nodes:
            return None
        node = pick(nodes, rng)
        sources = other.tree.by_symbol.get(site.tree.symbols[node])
        return site.tree.replaced(node, other.tree.below(pick(sources, rng))) if sources else None

    def _open_to_choice(self, site: Site) -> list[int]:
        return [node for node, symbol in enumerate(site.tree.symbols) if symbol in self._varied]

    def enclose(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """A new item around a few neighbours in a row."""
        row = row_of(site, rng)
        if row is None:
            return None
        first = below(len(row.items), rng)
        last = first + 1 + below(min(LONGEST_SEGMENT, len(row.items) - first), rng)
        template = self._opened(site, row, (first, last), rng)
        return self._filled(template, row.items[first:last], rng)

    def convert(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """What is around a row derived anew, around the same items."""
        row = row_of(site, rng)
        if row is None:
            return None
        above = [node for node in self._open_to_choice(site) if node < row.node < site.tree.ends[node]]
        return self._filled(site.tree.replaced(above[-1], (None,)), row.items, rng) if above else None

    def _filled(self, template: Template | None, items: Sequence[Item], rng: np.random.Generator) -> Template | None:
        """The template with its open place derived, and the items in a row that came with it."""
        derived = self.short.complete(template, rng) if template and None in template else None
        if template is None or derived is None:
            return None
        first, end = template.index(None), len(derived) - template[::-1].index(None)
        site = self.site(derived)
        rows = [row for row in site.rows if first <= row.node < end]
        if not rows:
            return None
        row = pick(rows, rng)
        kept = [item for item in items if self.rows.admits(row.symbol, item)]
        at = below(len(row.items) + 1, rng)
        cut = (at, at) if rng.random() < KEEP else (0, len(row.items))
        return self._spliced(site, row, cut, kept) if kept else None
