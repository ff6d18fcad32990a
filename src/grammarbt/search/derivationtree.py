"""A derivation as a tree: in leftmost order it is its tree in preorder, so that a sub-tree is a slice of it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from attrs import field, frozen

from grammarbt.grammar import BoundGrammar
from grammarbt.search.derivations import Template


@frozen(slots=False)  # slots=False: cached_property keeps its value in the instance's dict
class DerivationTree:
    """A derivation as a tree; a node is a place in it.

    Attributes:
        steps: productions in preorder, which is leftmost order; None where a nonterminal is left open.
        symbols: per node, the nonterminal.
        ends: per node, the place after its sub-tree.
    """

    steps: Template
    symbols: tuple[int, ...] = field(eq=False, repr=False)
    ends: tuple[int, ...] = field(eq=False, repr=False)

    @cached_property
    def by_symbol(self) -> dict[int, list[int]]:
        """The nodes of each nonterminal."""
        found: dict[int, list[int]] = {}
        for at, symbol in enumerate(self.symbols):
            found.setdefault(symbol, []).append(at)
        return found

    def children(self, at: int) -> Iterator[int]:
        """The nodes below a node, left to right."""
        child = at + 1
        while child < self.ends[at]:
            yield child
            child = self.ends[child]

    def below(self, at: int) -> Template:
        """The sub-tree of a node."""
        return self.steps[at : self.ends[at]]

    def replaced(self, at: int, part: Template) -> Template:
        """The whole derivation with another sub-tree at a node."""
        return self.steps[:at] + part + self.steps[self.ends[at] :]


def derivation_tree(grammar: BoundGrammar, steps: Template) -> DerivationTree:
    """The derivation tree of a leftmost derivation."""
    parts = grammar.parts
    symbols: list[int] = []
    pending = [grammar.start_symbol]
    for production in steps:
        symbols.append(pending.pop())
        if production is not None:
            pending += reversed(parts[production])
    ends = [0] * len(steps)
    for at in range(len(steps) - 1, -1, -1):
        end, step = at + 1, steps[at]
        if step is not None:
            for _ in parts[step]:
                end = ends[end]
        ends[at] = end
    return DerivationTree(steps, tuple(symbols), tuple(ends))
