"""Trees as lists: a control node at the root, and under it one sub-tree of a block after the other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from attrs import frozen

from grammarbt.bt import BehaviorTree, Fallback
from grammarbt.bt import Sequence as SequenceNode
from grammarbt.errors import GrammarError
from grammarbt.grammar import BoundGrammar, Derivation, SententialForm
from grammarbt.search.blocks import Piece, piece_of
from grammarbt.search.derivations import (
    Step,
    Template,
    block_derivations,
    complete,
    leftmost,
)

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
        self._templates: dict[tuple[int, ...], Template | None] = {}
        self._known_steps: dict[SententialForm, list[tuple[int, SententialForm]]] = {}
        self._kinds: dict[Template, type[Fallback | SequenceNode]] = {}
        self._independent = all(_is_independent(grammar, block) for block in grammar.blocks)

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
        return self._template(blocks) is not None

    def assemble(self, pieces: Sequence[Piece]) -> ListedTree | None:
        """The tree of these pieces, or None if it is not in the language."""
        template = self._template(tuple(piece.block for piece in pieces))
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

    def _template(self, blocks: tuple[int, ...]) -> Template | None:
        if blocks not in self._templates:
            self._templates[blocks] = self._derived(blocks)
        return self._templates[blocks]

    def _derived(self, blocks: tuple[int, ...]) -> Template | None:
        """A derivation of the row of blocks, found depth first; only what is not a block is rewritten."""
        pending: list[tuple[SententialForm, tuple[Step, ...]]] = [(self.grammar.start(), ())]
        seen = {self.grammar.start()}
        while pending:
            form, steps = pending.pop()
            open_ = [at for at in self.grammar.positions(form) if form.symbols[at] not in self.grammar.blocks]
            if not open_:
                return leftmost(self.grammar, steps)
            position = open_[0]
            for production, after in self._steps(form, position):
                if after not in seen and self._may_become(after, blocks):
                    seen.add(after)
                    pending.append((after, (*steps, (form, position, production))))
        return None

    def _steps(self, form: SententialForm, position: int) -> list[tuple[int, SententialForm]]:
        if form not in self._known_steps:
            legal = self.grammar.legal(form, position)
            self._known_steps[form] = [(number, self.grammar.apply(form, number, position)) for number in legal]
        return self._known_steps[form]

    def _may_become(self, form: SententialForm, blocks: tuple[int, ...]) -> bool:
        """Whether the blocks before the first other nonterminal are right, and not too many nonterminals are there."""
        row = [form.symbols[at] for at in self.grammar.positions(form)]
        first = next((at for at, symbol in enumerate(row) if symbol not in self.grammar.blocks), len(row))
        whole = first == len(row)
        fits = len(row) == len(blocks) if whole else len(row) <= len(blocks)
        return fits and tuple(row[:first]) == blocks[:first]


def _is_independent(grammar: BoundGrammar, block: int) -> bool:
    """Whether what stands inside the block has no say in what may stand around it."""
    around = grammar.encloses_of(block)
    pending, met = [block], {block}
    while pending:
        for production in grammar.by_lhs.get(pending.pop(), ()):
            if any(production.use[constraint] for constraint in around):
                return False
            new = [symbol for symbol in production.rhs if grammar.is_nonterminal(symbol) and symbol not in met]
            met.update(new)
            pending.extend(new)
    return not around & grammar.depth_constraints
