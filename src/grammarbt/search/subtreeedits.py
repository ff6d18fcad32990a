"""Edits of sub-trees, wherever they hang: derived again, exchanged, wrapped up, put in the place of what is around them."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping
from itertools import accumulate

import numpy as np

from grammarbt.search.derivations import Template
from grammarbt.search.loops import Loops
from grammarbt.search.moves import pick
from grammarbt.search.site import Edit, Site, Sites


class SubtreeEdits:
    """Each edit changes a site at random; where it does not apply, it gives None.

    Args:
        sites: of the grammar.

    Attributes:
        weights: how often each edit is to be drawn.
    """

    def __init__(self, sites: Sites) -> None:
        self.sites = sites
        self.loops = Loops(sites.grammar)
        self.weights: Mapping[Edit, float] = {
            self.regenerate: 2.0,
            self.exchange: 0.7,
            self.wrap: 1.0,
            self.hoist: 0.7,
            self.swap: 0.7,
        }

    def regenerate(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """A sub-tree derived again, a small one rather than a large one."""
        tree = site.tree
        nodes = self.sites.open_to_choice(site.tree)
        bounds = list(accumulate(1.0 / (tree.ends[node] - node) for node in nodes))
        if not nodes:
            return None
        return tree.replaced(nodes[bisect_right(bounds, rng.random() * bounds[-1], hi=len(nodes) - 1)], (None,))

    def exchange(self, site: Site, other: Site, rng: np.random.Generator) -> Template | None:
        """A sub-tree of the other in the place of one from the same nonterminal."""
        nodes = self.sites.open_to_choice(site.tree)
        if not nodes:
            return None
        node = pick(nodes, rng)
        sources = other.tree.by_symbol.get(site.tree.symbols[node])
        return site.tree.replaced(node, other.tree.below(pick(sources, rng))) if sources else None

    def wrap(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """Something new around a sub-tree."""
        nodes = [node for node, symbol in enumerate(site.tree.symbols) if self.loops.of(symbol)]
        if not nodes:
            return None
        node = pick(nodes, rng)
        before, behind = pick(self.loops.of(site.tree.symbols[node]), rng)
        return site.tree.replaced(node, (*before, *site.tree.below(node), *behind))

    def hoist(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """A sub-tree in the place of one around it, from the same nonterminal."""
        tree = site.tree
        pairs = [
            (node, inner)
            for own in tree.by_symbol.values()
            for node in own
            for inner in own
            if node < inner < tree.ends[node]
        ]
        if not pairs:
            return None
        node, inner = pick(pairs, rng)
        return tree.replaced(node, tree.below(inner))

    def swap(self, site: Site, _: Site, rng: np.random.Generator) -> Template | None:
        """Two sub-trees from the same nonterminal, each in the other's place."""
        tree = site.tree
        nodes = self.sites.open_to_choice(site.tree)
        if not nodes:
            return None
        node = pick(nodes, rng)
        other = pick(tree.by_symbol[tree.symbols[node]], rng)
        first, second = min(node, other), max(node, other)
        if tree.ends[first] > second or tree.below(first) == tree.below(second):
            return None
        steps, ends = tree.steps, tree.ends
        between = steps[ends[first] : second]
        return (*steps[:first], *tree.below(second), *between, *tree.below(first), *steps[ends[second] :])
