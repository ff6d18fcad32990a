"""Leaves that a grammar cannot tell apart: counting needs only one of the states that differ by swapping them.

If every production of a leaf has a twin for another one, swapping the two maps derivations onto derivations, so as many
words follow a set of states as follow its image. Graphs for counting stay small that way: of leaves that are alike only
how many are used matters, not which.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from typing import TypeAlias

from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.leftmost import Word
from grammarbt.grammar.table import CLOSE, Production, ProductionTable

Item: TypeAlias = tuple[Word, SententialForm]
"""A row of terminals still to be spelled, and the state after them."""

_Mask: TypeAlias = tuple[int, int]
"""A constraint of uniqueness, and what a scope of it has used."""


class Symmetry:
    """Swaps leaves of a grammar that are alike."""

    def __init__(self, grammar: ProductionTable) -> None:
        self.grammar = grammar
        using = _using(grammar)
        self.bits = {leaf: dict(_bits(grammar, own)) for leaf, own in using.items()}
        self.classes = _classes(using, self.bits)
        self._swaps = cache(self._computed_swaps)

    def representative(self, items: Iterable[Item]) -> tuple[Item, ...]:
        """The items, or an image of them; often the same one for sets that are images of each other."""
        ordered = sorted(items, key=by_number)
        masks = dict.fromkeys(mask for _, state in ordered for _, _, mask in self._masks(state))
        if not self.classes or not masks:
            return tuple(ordered)
        renamed, images = self._swaps(tuple(masks))
        swapped = ((tuple(renamed.get(s, s) for s in row), self._image(state, images)) for row, state in ordered)
        return tuple(sorted(swapped, key=by_number))

    def _masks(self, state: SententialForm) -> Iterator[tuple[int, int, _Mask]]:
        """What the state's scopes have used of constraints of uniqueness, with the places in `used`."""
        markers = (symbol for symbol in state.symbols if symbol < CLOSE)
        for scope, (marker, used) in enumerate(zip(markers, state.used, strict=True)):
            for at, constraint in enumerate(self.grammar.opens_of(self.grammar.opened_by(marker))):
                if self.grammar.costs.constraints[constraint].kind == "unique":
                    yield scope, at, (constraint, used[at])

    def _image(self, state: SententialForm, images: Mapping[_Mask, int]) -> SententialForm:
        used = [list(own) for own in state.used]
        for scope, at, mask in self._masks(state):
            used[scope][at] = images[mask]
        return SententialForm(state.symbols, tuple(map(tuple, used)))

    def _computed_swaps(self, masks: tuple[_Mask, ...]) -> tuple[Mapping[int, int], Mapping[_Mask, int]]:
        """New names that put the leaves of each class that are used most first; and the masks under these names."""
        renamed: dict[int, int] = {}
        for alike in self.classes:
            ranked = sorted(alike, key=lambda leaf: [self._is_used(leaf, mask) for mask in masks], reverse=True)
            renamed.update(zip(ranked, alike, strict=True))
        return renamed, {mask: self._renamed_mask(mask, renamed) for mask in masks}

    def _renamed_mask(self, mask: _Mask, renamed: Mapping[int, int]) -> int:
        constraint, found = mask
        moved = [leaf for leaf in renamed if constraint in self.bits[leaf]]
        others = found & ~sum(self.bits[leaf][constraint] for leaf in moved)
        return others | sum(self.bits[renamed[leaf]][constraint] for leaf in moved if self._is_used(leaf, mask))

    def _is_used(self, leaf: int, mask: _Mask) -> bool:
        return bool(mask[1] & self.bits[leaf].get(mask[0], 0))


def by_number(item: Item) -> tuple[object, ...]:
    """An order of items that is the same in every process."""
    return item[0], item[1].symbols, item[1].used


def _using(grammar: ProductionTable) -> dict[int, list[Production]]:
    """The productions of each terminal that never stands beside anything else."""
    found: dict[int, list[Production]] = {}
    beside: set[int] = set()
    for production in grammar.productions:
        for symbol in dict.fromkeys(production.rhs):
            found.setdefault(symbol, []).append(production)
            if len(production.rhs) > 1:
                beside.add(symbol)
    return {symbol: own for symbol, own in found.items() if symbol < grammar.start_symbol and symbol not in beside}


def _bits(grammar: ProductionTable, own: Iterable[Production]) -> Iterator[tuple[int, int]]:
    """What a leaf uses up of each constraint of uniqueness."""
    for at, constraint in enumerate(grammar.costs.constraints):
        if constraint.kind == "unique":
            use = 0
            for production in own:
                use |= production.use[at]
            if use:
                yield at, use


def _classes(
    using: Mapping[int, list[Production]], bits: Mapping[int, Mapping[int, int]]
) -> tuple[tuple[int, ...], ...]:
    """Leaves that come from the same nonterminals and use up the same kinds of things, a bit each."""
    found: dict[object, list[int]] = {}
    for leaf, own in using.items():
        if all(use.bit_count() == 1 for use in bits[leaf].values()):
            spent = [tuple(bool(use) if at in bits[leaf] else use for at, use in enumerate(p.use)) for p in own]
            found.setdefault((tuple(p.lhs for p in own), tuple(spent), tuple(bits[leaf])), []).append(leaf)
    return tuple(tuple(alike) for alike in found.values() if len(alike) > 1)
