"""Elements of a tree's lists that never acted."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from grammarbt.bt import Action, Condition
from grammarbt.search.derivationtree import DerivationTree
from grammarbt.search.moves import Moves


class IdleElements:
    """Finds and takes away elements of lists of which no leaf was ticked.

    Args:
        moves: of the grammar.
    """

    def __init__(self, moves: Moves) -> None:
        self.moves = moves
        self.grammar = moves.grammar
        tokens = enumerate(self.grammar.terminals)
        self._leaves = frozenset(at for at, token in tokens if isinstance(token, Action | Condition))
        self._own = [sum(symbol in self._leaves for symbol in own.rhs) for own in self.grammar.productions]

    def removed(self, tree: DerivationTree, ticks: Sequence[int], rng: np.random.Generator) -> DerivationTree:
        """The tree without them, as far as the language allows.

        Args:
            tree: a whole derivation.
            ticks: how often each leaf of its tree was ticked.
            rng: chance.
        """
        shorter: DerivationTree | None = tree
        while shorter is not None:
            tree = shorter
            shorter, ticks = self._one_removed(tree, ticks, rng)
        return tree

    def _one_removed(
        self, tree: DerivationTree, ticks: Sequence[int], rng: np.random.Generator
    ) -> tuple[DerivationTree | None, Sequence[int]]:
        """The tree and its ticks without one of them; no tree if that cannot be."""
        starts = self._first_leaves(tree)
        for node in self.moves.elements(tree):
            first, last = starts[node], starts[node] + self._leaves_below(tree, node)
            if first < last and not any(ticks[first:last]):
                found = self.moves.without(tree, node, rng)
                if found is not None:
                    return self.moves.tree(found), (*ticks[:first], *ticks[last:])
        return None, ticks

    def _first_leaves(self, tree: DerivationTree) -> list[int]:
        """Per node, how many leaves of the tree stand before it."""
        found: list[int] = []
        pending = [self.grammar.start_symbol]
        leaves = 0
        while pending:
            symbol = pending.pop()
            if symbol < self.grammar.start_symbol:
                leaves += symbol in self._leaves
                continue
            production = tree.steps[len(found)]
            found.append(leaves)
            if production is not None:
                pending += reversed(self.grammar.productions[production].rhs)
        return found

    def _leaves_below(self, tree: DerivationTree, node: int) -> int:
        return sum(self._own[step] for step in tree.below(node) if step is not None)
