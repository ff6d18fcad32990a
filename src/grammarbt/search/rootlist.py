"""Trees as lists: a control node at the root, and under it one sub-tree of a block after the other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from attrs import frozen

from grammarbt.bt import BehaviorTree, Fallback
from grammarbt.bt import Sequence as SequenceNode
from grammarbt.errors import GrammarError
from grammarbt.grammar import BoundGrammar, Derivation, is_independent
from grammarbt.search.blockrows import BlockRows
from grammarbt.search.blocks import Piece, piece_of
from grammarbt.search.derivations import Template, block_derivations, complete

SAMPLES = 20
"""Random words that must have the shape of a list before the language is taken for one of lists."""


@frozen(eq=False)
class ListedTree:
    """A tree of the language, as a list of pieces."""

    pieces: tuple[Piece, ...]
    tree: BehaviorTree
    derivation: Derivation


class RootList:
    """Puts lists of pieces together to trees, if the language has them."""

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self._rows = BlockRows(grammar)
        self._kinds: dict[Template, type[Fallback | SequenceNode]] = {}
        self._independent = all(is_independent(grammar, block) for block in grammar.blocks)

    def fits(self, rng: np.random.Generator) -> bool:
        """Whether random words of the language are such lists."""
        return bool(self.grammar.blocks) and all(self._is_list(self.sample(rng)) for _ in range(SAMPLES))

    def _is_list(self, sampled: ListedTree) -> bool:
        root = sampled.tree
        trees = tuple(piece.tree for piece in sampled.pieces)
        return isinstance(root, Fallback | SequenceNode) and root.children == trees

    def sample(self, rng: np.random.Generator) -> ListedTree:
        """A random tree."""
        derivation = self.grammar.sample(rng)
        pieces = [piece_of(self.grammar, block, own) for block, own in block_derivations(self.grammar, derivation)]
        return ListedTree(tuple(pieces), self.grammar.tree(self.grammar.derive(derivation)), derivation)

    def recognise(self, tree: BehaviorTree, most: int) -> ListedTree | None:
        """The list that is this tree, if the language has it; looks at the first `most` words of each block."""
        if not isinstance(tree, Fallback | SequenceNode):
            return None
        pieces = [piece for child in tree.children if (piece := self._recognised(child, most))]
        listed = self.assemble(pieces)
        return listed if listed is not None and listed.tree == tree else None

    def _recognised(self, tree: BehaviorTree, most: int) -> Piece | None:
        for block in self.grammar.blocks:
            for derivation, word in self.grammar.enumerate(block, most):
                if self.grammar.tree_of(word) == tree:
                    return piece_of(self.grammar, block, derivation)
        return None

    def allows(self, blocks: tuple[int, ...]) -> bool:
        """Whether the language has lists of these blocks in this order."""
        return self._rows.template(blocks) is not None

    def assemble(self, pieces: Sequence[Piece]) -> ListedTree | None:
        """The tree of these pieces, or None if it is not in the language."""
        template = self._rows.template(tuple(piece.block for piece in pieces))
        if template is None:
            return None
        derivation = complete(template, [piece.derivation for piece in pieces])
        if not self._independent and not self._is_legal(derivation):
            return None
        trees = tuple(piece.tree for piece in pieces)
        kind = self._kinds.get(template)
        if kind is None:
            kind = self._kinds[template] = self._kind(derivation)
        return ListedTree(tuple(pieces), kind(trees), derivation)

    def _kind(self, derivation: Derivation) -> type[Fallback | SequenceNode]:
        root = self.grammar.tree(self.grammar.derive(derivation))
        return SequenceNode if isinstance(root, SequenceNode) else Fallback

    def _is_legal(self, derivation: Derivation) -> bool:
        try:
            self.grammar.derive(derivation)
        except GrammarError:  # a constraint on the whole tree, such as its size
            return False
        return True
