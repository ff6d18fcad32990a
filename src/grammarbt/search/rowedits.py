"""Edits of rows: items come, go, change places, and get something around them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
from attrs import evolve

from grammarbt.search.derivations import Template
from grammarbt.search.moves import pick
from grammarbt.search.rows import Item, Row
from grammarbt.search.short import ShortFirst
from grammarbt.search.site import Edit, Site, Sites, below, row_of

Items: TypeAlias = tuple[Item, ...]

LONGEST_SEGMENT = 3
ACROSS = 0.4
"""Chance that a moved item goes to another row."""
EVEN = 0.5
KEEP = 0.3
"""Chance that what is derived around a segment keeps its own items too."""


class RowEdits:
    """Each edit changes a site at random; where it does not apply, it gives None.

    Args:
        sites: of the grammar.
        short: derives what comes new around a segment.

    Attributes:
        weights: how often each edit is to be drawn.
    """

    def __init__(self, sites: Sites, short: ShortFirst) -> None:
        self.sites = sites
        self.rows = sites.rows
        self.short = short
        self.weights: Mapping[Edit, float] = {
            self.insert: 3.0,
            self.delete: 1.5,
            self.replace: 1.5,
            self.move: 1.5,
            self.copy: 1.0,
            self.shift: 1.5,
            self.enclose: 1.5,
            self.splice: 0.7,
            self.convert: 0.7,
        }

    def insert(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """A new item anywhere in a row."""
        gaps = [(row, at) for row in site.rows for at in range(len(row.items) + 1)]
        if not gaps:
            return None
        row, at = pick(gaps, rng)
        return self._opened(site, row, (at, at), rng)

    def _opened(self, site: Site, row: Row, cut: tuple[int, int], rng: np.random.Generator) -> Template | None:
        """The derivation with an item still to be derived in the place of some, of a kind that fits there."""
        found = [self.spliced(site, row, cut, (item,)) for item in self.rows.items[row.symbol]]
        fitting = [template for template in found if template is not None]
        return pick(fitting, rng) if fitting else None

    def copy(self, site: Site, other: Site, rng: np.random.Generator) -> Template | None:
        """An item of another derivation, anywhere in a row."""
        source, row = row_of(other, rng), row_of(site, rng)
        if source is None or row is None:
            return None
        at = below(len(row.items) + 1, rng)
        return self.spliced(site, row, (at, at), (pick(source.items, rng),))

    def spliced(self, site: Site, row: Row, cut: tuple[int, int], items: Sequence[Item]) -> Template | None:
        """The derivation with items in the place of those from `cut[0]` to `cut[1]`, exclusive."""
        changed = [*row.items[: cut[0]], *items, *row.items[cut[1] :]]
        return site.rewritten(row, self.rows.written(row, changed))

    def delete(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """A row without one of its items."""
        row = row_of(site, rng)
        if row is None:
            return None
        at = below(len(row.items), rng)
        return self.spliced(site, row, (at, at + 1), ())

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
        return self.spliced(site, row, (at, at + 1), kept)

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
        return site.rewritten(row, self.rows.written(row, left))

    def _moved_across(
        self, site: Site, row: Row, left: Sequence[Item], item: Item, rng: np.random.Generator
    ) -> Template | None:
        others = [
            other
            for other in site.rows
            if (other.node >= row.end or row.node >= other.end) and self.rows.admits(other.symbol, item)
        ]
        if not others:
            return None
        other = pick(others, rng)
        at = below(len(other.items) + 1, rng)
        shorter = self.rows.written(row, left)
        longer = self.rows.written(other, [*other.items[:at], item, *other.items[at:]])
        if shorter is None or longer is None:
            return None
        (first, before), (second, behind) = sorted([(row, shorter), (other, longer)], key=lambda pair: pair[0].node)
        steps = site.tree.steps
        return (*steps[: first.node], *before, *steps[first.end : second.node], *behind, *steps[second.end :])

    def shift(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """The border of a row moves: a few items go out to the row around it, or come in from there, in the same order."""
        inner = row_of(site, rng)
        around = [(row, at) for row in site.rows for at in range(len(row.items)) if inner and row.holds(at, inner.node)]
        if inner is None or not around:
            return None
        outer, at = pick(around, rng)
        before, own, after = _border_moved(outer.items[:at], inner.items, outer.items[at + 1 :], rng)
        part = self.rows.written(inner, own)
        if part is None:
            return None
        start, item = outer.starts[at], outer.items[at]
        steps, end = site.tree.steps, start + len(item.content)
        changed = evolve(item, content=(*steps[start : inner.node], *part, *steps[inner.end : end]))
        return site.rewritten(outer, self.rows.written(outer, [*before, changed, *after]))

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
        above = [node for node in self.sites.open_to_choice(site.tree) if node < row.node < site.tree.ends[node]]
        return self._filled(site.tree.replaced(above[-1], (None,)), row.items, rng) if above else None

    def _filled(self, template: Template | None, items: Sequence[Item], rng: np.random.Generator) -> Template | None:
        """The template with its open place derived, and the items in a row that came with it."""
        derived = self.short.complete(template, rng) if template and None in template else None
        if template is None or derived is None:
            return None
        first, end = template.index(None), len(derived) - template[::-1].index(None)
        site = self.sites.of(derived)
        rows = [row for row in site.rows if first <= row.node < end]
        if not rows:
            return None
        row = pick(rows, rng)
        kept = [item for item in items if self.rows.admits(row.symbol, item)]
        at = below(len(row.items) + 1, rng)
        cut = (at, at) if rng.random() < KEEP else (0, len(row.items))
        return self.spliced(site, row, cut, kept) if kept else None


def _border_moved(before: Items, own: Items, after: Items, rng: np.random.Generator) -> tuple[Items, Items, Items]:
    """A few items more, or less, of a line for its middle part, at one of its two borders."""
    few = 1 + below(LONGEST_SEGMENT, rng)
    more = few if rng.random() < EVEN else -few
    if rng.random() < EVEN:
        line, cut = (*own, *after), max(0, len(own) + more)
        return before, line[:cut], line[cut:]
    line, cut = (*before, *own), max(0, len(before) - more)
    return line[:cut], line[cut:], after
