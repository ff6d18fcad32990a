"""Random edits of derivations in any grammar.

An edit puts slices of derivations together, with open places for what is new; `ShortFirst` then fills those, and says
whether the language has such a tree. Most edits work on rows, the lists of a derivation.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from itertools import accumulate

import numpy as np

from grammarbt.grammar import BoundGrammar, Derivation
from grammarbt.search.derivations import Template
from grammarbt.search.moves import pick
from grammarbt.search.rowedits import RowEdits
from grammarbt.search.short import ShortFirst
from grammarbt.search.shrinking import Shrinking
from grammarbt.search.site import Edit, Site, Sites
from grammarbt.search.states import States
from grammarbt.search.subtreeedits import SubtreeEdits

SHORTNESS = 0.7
NOVELTY = 0.5
"""Share of the edits whose new sub-trees are to bring something that the derivation does not have yet."""
NOVEL_DRAWS = 3
"""Further draws of one that does not."""
FURTHER_EDIT = 0.35
MOST_EDITS = 4


class Edits:
    """Random edits of derivations.

    Args:
        grammar: the language.

    Attributes:
        kinds: the edits by name.
    """

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self.states = States(grammar)
        self.short = ShortFirst(self.states, SHORTNESS)
        self.sites = Sites(grammar)
        rows = RowEdits(self.sites, self.short)
        self.shrinking = Shrinking(self.sites, rows, self.short)
        weights = {**rows.weights, **SubtreeEdits(self.sites).weights}
        self.kinds = {edit.__name__: edit for edit in weights}
        self._edits = tuple(weights)
        self._shares = list(accumulate(weights.values()))

    def sample(self, rng: np.random.Generator) -> Derivation:
        """A random derivation of a tree, short ones first."""
        return self.short.sample(rng)

    def site(self, derivation: Template) -> Site:
        """A derivation, ready for edits."""
        return self.sites.of(derivation)

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
                    site = self.sites.of(derivation)
            if not further:
                break
        return None if found == first.tree.steps else found

    def _edited(self, edit: Edit, site: Site, other: Site, rng: np.random.Generator) -> Derivation | None:
        """Fill open places, some rather by productions that the derivation does not have yet."""
        template = edit(site, other, rng)
        if template is None:
            return None
        found = self.short.complete(template, rng)
        for _ in range(NOVEL_DRAWS if None in template and rng.random() < NOVELTY else 0):
            if found is None or not site.uses.issuperset(found):
                break
            found = self.short.complete(template, rng)
        return found
