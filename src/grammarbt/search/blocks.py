"""The derivation DAG of one block, say of a group's sub-trees, in leftmost order.

A block whose words can be listed keeps one word per behaviour, the shortest, and weights that make a random walk draw
short words first. A larger one is derived as the walks go, by the productions' own weights.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from graphlib import CycleError, TopologicalSorter
from itertools import accumulate
from math import exp, log

import numpy as np
from attrs import define, field, frozen

from grammarbt.bt import BehaviorTree, leaves
from grammarbt.grammar import BoundGrammar, Derivation, SententialForm
from grammarbt.search.bandits import Arm

SHORTNESS = 0.2
"""How much less a word weighs per token."""

FORMS_PER_WORD = 4
"""Partial sub-trees up to which a block is listed, per word that it may have."""

STREAM_DRAWS = 50
"""Draws in a row that were all had before, after which a stream begins again."""

Behaviour = Callable[[BehaviorTree], object]
"""Equal for trees of which one is enough."""


@frozen(cache_hash=True)
class Piece:
    """A sub-tree of a block.

    Attributes:
        block: the nonterminal.
        derivation: leftmost, from the block.
        word: the symbols; tells pieces apart.
        tree: the sub-tree.
        size: leaves of the sub-tree.
    """

    block: int
    derivation: Derivation = field(eq=False)
    word: tuple[int, ...]
    tree: BehaviorTree = field(eq=False)
    size: int = field(eq=False)


@define(eq=False)
class BlockNode(Arm):
    """A partial sub-tree.

    Attributes:
        form: what it stands for.
        children: (production, node, weight); None until it is expanded.
        bounds: running sums of the weights; None until one child is drawn by weight.
        piece: the sub-tree, once it was drawn.
    """

    form: SententialForm
    children: list[tuple[int, BlockNode, float]] | None = field(default=None, repr=False)
    bounds: list[float] | None = field(default=None, init=False, repr=False)
    piece: Piece | None = field(default=None, init=False, repr=False)


def piece_of(grammar: BoundGrammar, block: int, derivation: Derivation) -> Piece:
    """The piece that a leftmost derivation from the block gives."""
    form = grammar.derive(derivation, block)
    tree = grammar.tree(form)
    return Piece(block, derivation, form.symbols, tree, len(leaves(tree)))


class BlockDag:
    """One block's partial sub-trees, with the credit they earned.

    Args:
        grammar: the language.
        block: the nonterminal.
        behaviour: tells which words are worth keeping apart.
        most: words up to which the block is listed.
    """

    def __init__(self, grammar: BoundGrammar, block: int, behaviour: Behaviour, most: int) -> None:
        self.grammar = grammar
        self.block = block
        self.nodes: dict[SententialForm, BlockNode] = {}
        self.root = self._node(grammar.start(block))
        listed = self._list(most)
        if listed is None:
            self.nodes.clear()
            self.root = self._node(grammar.start(block))
            self.words = most
        else:
            self.words = self._prune(listed, behaviour)

    @property
    def weight(self) -> float:
        """How much the block deserves when nothing is known: grows slowly with its words; it has some."""
        return log(self.words) + 0.7

    def draw(self, rng: np.random.Generator, prefix: Derivation = ()) -> tuple[list[BlockNode], Piece]:
        """A word and the nodes on the way to it: along `prefix`, as far as it leads, and from there at random by weight."""
        path, derivation = self._follow(prefix)
        node, random = path[-1], rng.random
        while children := self._expanded(node) if node.children is None else node.children:
            bounds = node.bounds or _bounds(node, children)
            production, node, _ = children[bisect_right(bounds, random() * bounds[-1], 0, len(bounds) - 1)]
            path.append(node)
            derivation.append(production)
        return path, node.piece or self._piece(node, derivation)

    def _follow(self, prefix: Derivation) -> tuple[list[BlockNode], list[int]]:
        path, derivation = [self.root], list[int]()
        for production in prefix:
            step = next((node for number, node, _ in self._expanded(path[-1]) if number == production), None)
            if step is None:
                break
            path.append(step)
            derivation.append(production)
        return path, derivation

    def _piece(self, node: BlockNode, derivation: list[int]) -> Piece:
        if node.piece is None:
            node.piece = piece_of(self.grammar, self.block, tuple(derivation))
        return node.piece

    def _node(self, form: SententialForm) -> BlockNode:
        node = self.nodes.get(form)
        if node is None:
            node = self.nodes[form] = BlockNode(form)
        return node

    def _expanded(self, node: BlockNode) -> list[tuple[int, BlockNode, float]]:
        if node.children is None:
            word = self.grammar.is_word(node.form)
            legal = () if word else self.grammar.legal(node.form)
            node.children = [
                (production, self._after(node, production), self._weight(production)) for production in legal
            ]
        return node.children

    def _after(self, node: BlockNode, production: int) -> BlockNode:
        return self._node(self.grammar.apply(node.form, production))

    def _weight(self, production: int) -> float:
        return self.grammar.productions[production].weight

    def _list(self, most: int) -> list[BlockNode] | None:
        """Every node, each after its children; None if there are more than `most` words or the walk has no end."""
        words, pending = 0, [self.root]
        while pending:
            node = pending.pop()
            if node.children is None:
                children = [child for _, child, _ in self._expanded(node)]
                words += not children
                if words > most or len(self.nodes) > FORMS_PER_WORD * most:
                    return None
                pending.extend(children)
        return self._children_first()

    def _children_first(self) -> list[BlockNode] | None:
        order = TopologicalSorter(
            {node: [child for _, child, _ in node.children or ()] for node in self.nodes.values()}
        )
        try:
            return list(order.static_order())
        except CycleError:
            return None

    def _prune(self, nodes: list[BlockNode], behaviour: Behaviour) -> int:
        """Keep the shortest word of each behaviour and what leads to it; gives the number of words kept."""
        words = [node for node in nodes if self.grammar.is_word(node.form)]
        words.sort(key=lambda node: self._tokens(node.form))
        kept: dict[object, BlockNode] = {}
        for node in words:
            kept.setdefault(behaviour(self.grammar.tree(node.form)), node)
        weights = {node: exp(-SHORTNESS * self._tokens(node.form)) for node in kept.values()}
        for node in nodes:
            if node.children:
                weighed = [(number, child, weights[child]) for number, child, _ in node.children if child in weights]
                node.children = weighed
                if weighed:
                    weights[node] = sum(weight for _, _, weight in weighed)
        return len(kept)

    def _tokens(self, form: SententialForm) -> int:
        return sum(not self.grammar.is_marker(symbol) for symbol in form.symbols)


def _bounds(node: BlockNode, children: Sequence[tuple[int, BlockNode, float]]) -> list[float]:
    if node.bounds is None:
        node.bounds = list(accumulate(weight for _, _, weight in children))
    return node.bounds


class Stream:
    """Draws each sub-tree of a block once before any comes again.

    Args:
        dag: the block's.
    """

    def __init__(self, dag: BlockDag) -> None:
        self.dag = dag
        self._drawn: set[Piece] = set()

    def draw(self, rng: np.random.Generator, prefix: Derivation = ()) -> tuple[list[BlockNode], Piece]:
        """A sub-tree that has its turn; along a prefix, any."""
        for _ in range(STREAM_DRAWS):
            path, piece = self.dag.draw(rng, prefix)
            if prefix or piece not in self._drawn:
                self._drawn.add(piece)
                return path, piece
        self._drawn = {piece}
        return path, piece
