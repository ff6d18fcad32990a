"""Where edits begin: a derivation with its tree and its rows."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from attrs import frozen

from grammarbt.grammar import BoundGrammar
from grammarbt.search.derivations import Template
from grammarbt.search.derivationtree import DerivationTree, derivation_tree
from grammarbt.search.rows import Row, Rows


@frozen(eq=False)
class Site:
    """A derivation with its tree and its rows, from which edits begin."""

    tree: DerivationTree
    rows: list[Row]
    uses: frozenset[int | None]

    def rewritten(self, row: Row, part: Template | None) -> Template | None:
        """The derivation with a row written anew."""
        steps = self.tree.steps
        return None if part is None else (*steps[: row.node], *part, *steps[row.end :])


class Sites:
    """Makes sites.

    Args:
        grammar: the language.
    """

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self.rows = Rows(grammar)
        self._varied = frozenset(lhs for lhs, own in grammar.by_lhs.items() if len(own) > 1)

    def of(self, derivation: Template) -> Site:
        """A derivation, ready for edits."""
        tree = derivation_tree(self.grammar, derivation)
        return Site(tree, self.rows.of(tree), frozenset(derivation))

    def open_to_choice(self, tree: DerivationTree) -> list[int]:
        """The nodes whose nonterminal has more than one production."""
        return [node for node, symbol in enumerate(tree.symbols) if symbol in self._varied]


Edit = Callable[[Site, Site, np.random.Generator], Template | None]
"""Changes the first site at random, and may borrow from the second; the result may have open places."""


def row_of(site: Site, rng: np.random.Generator) -> Row | None:
    """A row, the more likely the more items it has; None if there is none."""
    drawn = below(sum(len(row.items) for row in site.rows), rng)
    for row in site.rows:
        drawn -= len(row.items)
        if drawn < 0:
            return row
    return None


def below(n: int, rng: np.random.Generator) -> int:
    """A whole number from 0 to n - 1."""
    return int(rng.random() * n)
