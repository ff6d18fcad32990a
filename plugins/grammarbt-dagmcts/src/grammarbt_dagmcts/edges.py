"""Productions between the nodes of a DAG, as columns of numbers."""

from __future__ import annotations

from array import array
from collections.abc import Iterator


class Edges:
    """Two linked lists run through the edges: those from the same parent, and those to the same child, last one first.

    Edges and nodes are numbered in the order in which they come; edge 0 is none, and ends the lists.

    Attributes:
        parent, child: per edge, the nodes that it joins.
        production: per edge, what leads from one to the other.
        place: per edge, which of the parent's nonterminals is rewritten, from the left.
    """

    def __init__(self) -> None:
        self.parent = array("I", [0])
        self.child = array("I", [0])
        self.production = array("I", [0])
        self.place = array("H", [0])
        self._next_below = array("I", [0])
        self._next_above = array("I", [0])
        self._first_below = array("I")
        self._first_above = array("I")

    def __len__(self) -> int:
        """How many edges there are."""
        return len(self.parent) - 1

    def add_node(self) -> None:
        """Make room for one more node."""
        self._first_below.append(0)
        self._first_above.append(0)

    def join(self, parent: int, child: int, production: int, place: int) -> int:
        """The edge between two nodes, which may have been there before, by whatever production."""
        for known in self.above(child):
            if self.parent[known] == parent:
                return known
        edge = len(self.parent)
        self.parent.append(parent)
        self.child.append(child)
        self.production.append(production)
        self.place.append(place)
        self._next_below.append(self._first_below[parent])
        self._next_above.append(self._first_above[child])
        self._first_below[parent] = self._first_above[child] = edge
        return edge

    def below(self, node: int) -> Iterator[int]:
        """The edges to a node's children."""
        edge = self._first_below[node]
        while edge:
            yield edge
            edge = self._next_below[edge]

    def above(self, node: int) -> Iterator[int]:
        """The edges from a node's parents."""
        edge = self._first_above[node]
        while edge:
            yield edge
            edge = self._next_above[edge]

    def children(self, node: int) -> list[int]:
        """The nodes below a node by one production."""
        return [self.child[edge] for edge in self.below(node)]

    def parents(self, node: int) -> list[int]:
        """The nodes above a node by one production."""
        return [self.parent[edge] for edge in self.above(node)]
