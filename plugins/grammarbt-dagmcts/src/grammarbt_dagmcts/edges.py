"""Productions between the nodes of a DAG, as columns of numbers."""

from __future__ import annotations

from array import array
from collections.abc import Iterable


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
        above, parents, following = self._first_above[child], self.parent, self._next_above
        known = above
        while known:
            if parents[known] == parent:
                return known
            known = following[known]
        edge = len(parents)
        parents.append(parent)
        self.child.append(child)
        self.production.append(production)
        self.place.append(place)
        self._next_below.append(self._first_below[parent])
        following.append(above)
        self._first_below[parent] = self._first_above[child] = edge
        return edge

    def below(self, node: int) -> list[int]:
        """The edges to a node's children."""
        return _listed(self._first_below[node], self._next_below)

    def above(self, node: int) -> list[int]:
        """The edges from a node's parents."""
        return _listed(self._first_above[node], self._next_above)

    def children(self, node: int) -> list[int]:
        """The nodes below a node by one production."""
        return [self.child[edge] for edge in self.below(node)]

    def parents(self, node: int) -> list[int]:
        """The nodes above a node by one production."""
        return [self.parent[edge] for edge in self.above(node)]

    def ancestors(self, nodes: Iterable[int]) -> list[int]:
        """The nodes and all that lead to them, each once, nearest first; written out, as every iteration asks for them."""
        order = list(nodes)
        found = set(order)
        parents, first, following = self.parent, self._first_above, self._next_above
        for node in order:  # grows while it is read
            edge = first[node]
            while edge:
                parent = parents[edge]
                if parent not in found:
                    found.add(parent)
                    order.append(parent)
                edge = following[edge]
        return order


def _listed(edge: int, following: array[int]) -> list[int]:
    found: list[int] = []
    while edge:
        found.append(edge)
        edge = following[edge]
    return found
