"""Moves from derivation to derivation within a language: regenerate, cross over, insert, delete, reorder.

A derivation in leftmost order is its derivation tree in preorder, so that a sub-tree is a slice of it. Each move puts
slices together, with open places for what is to be derived at random, and a walk along the leftmost states fills them
and says whether all constraints are kept.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeVar

import numpy as np

from grammarbt.grammar import BoundGrammar, Derivation
from grammarbt.search.derivations import Template
from grammarbt.search.derivationtree import DerivationTree, derivation_tree
from grammarbt.search.states import States

Item = TypeVar("Item")

TRIES = 20
"""Random choices tried before a move is given up."""


class Moves:
    """Random changes of derivations that stay in the language; each gives None when it finds no legal change.

    Repetitions, `x+` and `x*`, are recursive nonterminals of the bound grammar, as are lists that a grammar's author
    writes as recursive rules; insert, delete and reorder work on both.

    Args:
        grammar: the language.
        states: its leftmost states, if they are shared.
    """

    def __init__(self, grammar: BoundGrammar, states: States | None = None) -> None:
        self.grammar = grammar
        self.states = states or States(grammar)
        self._parts = grammar.parts
        self._varied = frozenset(lhs for lhs, own in grammar.by_lhs.items() if len(own) > 1)
        self._recursive = {
            lhs: [production.number for production in own if lhs in production.rhs]
            for lhs, own in grammar.by_lhs.items()
            if any(lhs in production.rhs for production in own)
        }

    def tree(self, steps: Template) -> DerivationTree:
        """The derivation tree of a leftmost derivation."""
        return derivation_tree(self.grammar, steps)

    def regenerate(self, tree: DerivationTree, rng: np.random.Generator, at: int | None = None) -> Derivation | None:
        """Derive the sub-tree of a node again, at random by weight; any node with a choice unless one is given."""
        nodes = [at] if at is not None else self._nodes(tree)
        for _ in range(TRIES if nodes else 0):
            node = pick(nodes, rng)
            found = self.states.complete(tree.replaced(node, (None,)), rng)
            if found is not None and found != tree.steps:
                return found
        return None

    def cross(self, tree: DerivationTree, other: DerivationTree, rng: np.random.Generator) -> Derivation | None:
        """The tree with a sub-tree of another one in the place of one from the same nonterminal."""
        nodes = [node for node in self._nodes(tree) if tree.symbols[node] in other.by_symbol]
        for _ in range(TRIES if nodes else 0):
            node = pick(nodes, rng)
            part = other.below(pick(other.by_symbol[tree.symbols[node]], rng))
            if part != tree.below(node):
                found = self.states.complete(tree.replaced(node, part), rng)
                if found is not None:
                    return found
        return None

    def insert(self, tree: DerivationTree, rng: np.random.Generator) -> Derivation | None:
        """A random element more in one of the lists, anywhere among those of its kind."""
        lists = [node for node, symbol in enumerate(tree.symbols) if symbol in self._recursive]
        for _ in range(TRIES if lists else 0):
            node = pick(lists, rng)
            found = self.states.complete(self._wider(tree, node, rng), rng)
            if found is not None:
                return found
        return None

    def _wider(self, tree: DerivationTree, node: int, rng: np.random.Generator) -> Template:
        symbol = tree.symbols[node]
        production = pick(self._recursive[symbol], rng)
        parts = self._parts[production]
        own = parts.index(symbol)
        before, after = parts[:own], parts[own + 1 :]
        part = (production, *(None for _ in before), *tree.below(node), *(None for _ in after))
        wider = self.tree(tree.replaced(node, part))
        elements: list[Template] = [tree.below(at) for at in self._alike(tree, node, (*before, *after))]
        elements.insert(int(rng.random() * (len(elements) + 1)), (None,))
        return _refilled(wider, self._alike(wider, node, (*before, *after)), elements)

    def delete(self, tree: DerivationTree, rng: np.random.Generator) -> Derivation | None:
        """One element less in one of the lists."""
        lists = self._lists(tree)
        for _ in range(TRIES if lists else 0):
            node = pick(lists, rng)
            elements = self._alike(tree, node, self._lost(tree, node))
            gone = pick(elements, rng) if elements else None
            found = self.states.complete(self._shorter(tree, node, gone), rng)
            if found is not None:
                return found
        return None

    def without(self, tree: DerivationTree, element: int, rng: np.random.Generator) -> Derivation | None:
        """The tree without a node that is an element of a list."""
        for node in self._lists(tree):
            if element in self._alike(tree, node, self._lost(tree, node)):
                found = self.states.complete(self._shorter(tree, node, element), rng)
                if found is not None:
                    return found
        return None

    def _lists(self, tree: DerivationTree) -> list[int]:
        """The nodes that have a list below them that is shorter by one element."""
        steps = enumerate(tree.steps)
        return [at for at, step in steps if step is not None and tree.symbols[at] in self._parts[step]]

    def _rest(self, tree: DerivationTree, node: int) -> int:
        return next(child for child in tree.children(node) if tree.symbols[child] == tree.symbols[node])

    def _lost(self, tree: DerivationTree, node: int) -> tuple[int, ...]:
        """The nonterminals that are no more when a list's rest takes its place."""
        rest = self._rest(tree, node)
        return tuple(tree.symbols[child] for child in tree.children(node) if child != rest)

    def _shorter(self, tree: DerivationTree, node: int, gone: int | None) -> Template:
        kind = self._lost(tree, node)
        shorter = self.tree(tree.replaced(node, tree.below(self._rest(tree, node))))
        elements = [tree.below(at) for at in self._alike(tree, node, kind) if at != gone]
        return _refilled(shorter, self._alike(shorter, node, kind), elements)

    def reorder(self, tree: DerivationTree, rng: np.random.Generator) -> Derivation | None:
        """One element of a list in another place among those of its kind."""
        rows = [row for row in self._rows(tree) if len(row) > 1]
        for _ in range(TRIES if rows else 0):
            row = pick(rows, rng)
            elements = [tree.below(at) for at in row]
            element = elements.pop(int(rng.random() * len(row)))
            elements.insert(int(rng.random() * len(row)), element)
            found = self.states.complete(_refilled(tree, row, elements), rng)
            if found is not None and found != tree.steps:
                return found
        return None

    def elements(self, tree: DerivationTree) -> list[int]:
        """The nodes that are elements of lists."""
        return [at for row in self._rows(tree) for at in row]

    def _nodes(self, tree: DerivationTree) -> list[int]:
        return [node for node, symbol in enumerate(tree.symbols) if symbol in self._varied]

    def _alike(self, tree: DerivationTree, node: int, kind: tuple[int, ...]) -> list[int]:
        """The elements of one kind, a nonterminal, in the list that a node belongs to; of several at once, none."""
        owners = (at for at in range(node - 1, -1, -1) if tree.ends[at] > node)
        owner = next((at for at in owners if tree.symbols[at] not in self._recursive), 0)
        return [at for at in self._elements(tree, owner) if (tree.symbols[at],) == kind]

    def _rows(self, tree: DerivationTree) -> Iterator[list[int]]:
        """The elements of each list, those of one kind together."""
        for node, symbol in enumerate(tree.symbols):
            if node == 0 or symbol not in self._recursive:
                kinds: dict[int, list[int]] = {}
                for at in self._elements(tree, node):
                    kinds.setdefault(tree.symbols[at], []).append(at)
                yield from kinds.values()

    def _elements(self, tree: DerivationTree, owner: int) -> list[int]:
        """The children of a node, with the elements of a list in the place of the list."""
        found = []
        pending = [owner]
        while pending:
            at = pending.pop()
            if at == owner or tree.symbols[at] in self._recursive:
                pending += reversed(list(tree.children(at)))
            else:
                found.append(at)
        return found


def pick(items: Sequence[Item], rng: np.random.Generator) -> Item:
    """One of the items, all equally likely."""
    return items[int(rng.random() * len(items))]


def _refilled(tree: DerivationTree, places: Sequence[int], elements: Sequence[Template]) -> Template:
    """The derivation with new sub-trees at some nodes, which lie left to right; unchanged where there is no place."""
    found: list[int | None] = []
    at = 0
    for place, element in zip(places, elements, strict=False):
        found += tree.steps[at:place]
        found += element
        at = tree.ends[place]
    return (*found, *tree.steps[at:])
