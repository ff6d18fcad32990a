"""The derivation DAG: sentential forms as nodes, single productions as edges.

A node is a number, and everything about nodes stands in columns: a search keeps millions of them.
"""

from __future__ import annotations

from array import array
from typing import TypeAlias

from grammarbt.grammar import BoundGrammar, Pieces, SententialForm, Spelling
from grammarbt_dagmcts.edges import Edges
from grammarbt_dagmcts.rewards import Rewards

ROOT = 0
"""The node of the start symbol."""

MAX_FANS = 50_000
"""Nodes of which the open children are kept."""

Fan: TypeAlias = "tuple[array[int], array[int]]"
"""Edges from a node, and the children that they lead to."""

_NONE_LEFT = array("I")


class Dag:
    """One node per sentential form; a new node is joined to all its parents in the DAG.

    Attributes:
        spelling: how forms are spelled.
        pieces: what is legal in them.
        texts: per node, its form.
        edges: between the nodes.
        rewards: per node, those of all roll-outs through it, each once.
        selections: per node, how often selection passed through it, apart from rewards.
        words: per node, whether nothing is left to derive.
        closed: per node, whether every word below it was proposed.
    """

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self.spelling = Spelling(grammar)
        self.pieces = Pieces(self.spelling)
        self.texts: list[str] = []
        self.edges = Edges()
        self.rewards = Rewards()
        self.selections = array("I")
        self.words = bytearray()
        self.closed = bytearray()
        self._fans: dict[int, Fan] = {}
        self._untried: list[array[int] | None] = []
        self._by_text: dict[str, int] = {}
        self.add(self.spelling.text(grammar.start()))

    def __len__(self) -> int:
        """How many nodes there are."""
        return len(self.texts)

    def form(self, node: int) -> SententialForm:
        """What a node stands for."""
        return self.spelling.form(self.texts[node])

    def find(self, text: str) -> int | None:
        """The node of a form, if there is one."""
        return self._by_text.get(text)

    def after(self, parent: int, place: int, production: int) -> int:
        """The edge by a legal production; the node below may have been there before."""
        text = self._applied(parent, place, production)
        known = self.find(text)
        return self._joined(parent, self.add(text) if known is None else known, production, place)

    def _applied(self, parent: int, place: int, production: int) -> str:
        text = self.texts[parent]
        return self.spelling.apply(text, production, self.spelling.positions(text)[place])

    def add(self, text: str) -> int:
        """A new node, joined to all its parents in the DAG."""
        node = self._by_text[text] = self._new(text)
        for above, production, at in self.spelling.parents(text):
            parent = self.find(above)
            if parent is not None:
                self._join(parent, node, production, at)
        return node

    def _new(self, text: str) -> int:
        self.texts.append(text)
        self.edges.add_node()
        self.rewards.add_node()
        self.selections.append(0)
        self.words.append(not self.spelling.nonterminals(text))
        self.closed.append(False)
        self._untried.append(None)
        return len(self.texts) - 1

    def _join(self, parent: int, child: int, production: int, at: int) -> None:
        self._joined(parent, child, production, self.spelling.place(self.texts[parent], at))

    def _joined(self, parent: int, child: int, production: int, place: int) -> int:
        self._fans.pop(parent, None)
        return self.edges.join(parent, child, production, place)

    # Productions that no selection took yet, as place · productions + production

    def untried(self, node: int) -> array[int]:
        """Those of a node; all that are legal before the first selection."""
        known = self._untried[node]
        if known is None:
            many = len(self.grammar.productions)
            options = self.pieces.options(self.texts[node])
            known = array("I", [place * many + production for place, production in options]) or _NONE_LEFT
            self._untried[node] = known
        return known

    def take_untried(self, node: int, at: int) -> tuple[int, int]:
        """Take the one at an index: the place of a nonterminal, and a production."""
        untried = self.untried(node)
        taken, untried[at] = untried[at], untried[-1]
        untried.pop()
        if not untried:
            self._untried[node] = _NONE_LEFT
        return divmod(taken, len(self.grammar.productions))

    def close(self, node: int) -> None:
        """Mark a node as having nothing left to propose, and every ancestor of which this is then true."""
        pending = [node]
        while pending:
            done = pending.pop()
            self.closed[done] = True
            for above in self.edges.parents(done):
                self._fans.pop(above, None)
                if not self.closed[above] and self._exhausted(above):
                    pending.append(above)

    def _exhausted(self, node: int) -> bool:
        return self._untried[node] is _NONE_LEFT and all(self.closed[child] for child in self.edges.children(node))

    def open_below(self, node: int) -> Fan:
        """The edges to children below which something is left to propose, last one first, and the children."""
        known = self._fans.get(node)
        if known is None:
            if len(self._fans) >= MAX_FANS:
                self._fans.clear()
            child, closed = self.edges.child, self.closed
            edges = array("I", [edge for edge in self.edges.below(node) if not closed[child[edge]]])
            known = self._fans[node] = edges, array("I", [child[edge] for edge in edges])
        return known

    # Ancestors

    def link_ancestors(self, node: int, k: int, most: int) -> None:
        """Join the node to its ancestors in the DAG within k inverse productions, by adding the forms between.

        At most `most` forms are looked at.
        """
        below, pending = self._search_above(node, k, most)
        while pending:
            text = pending.pop()
            known = self.find(text)
            parent = self.add(text) if known is None else known
            for child, production, at in below[text]:
                number = self.find(child)
                if number is None:
                    pending.append(child)
                else:
                    self._join(parent, number, production, at)

    def _search_above(self, node: int, k: int, most: int) -> tuple[dict[str, list[tuple[str, int, int]]], list[str]]:
        """The forms above the node, each with what they lead to and how, and which of them the DAG has."""
        layer = [self.texts[node]]
        below: dict[str, list[tuple[str, int, int]]] = {layer[0]: []}
        reached: list[str] = []
        for _ in range(k):
            above: list[str] = []
            for text in layer:
                for parent, production, at in self.spelling.parents(text):
                    if parent in below:
                        below[parent].append((text, production, at))
                    elif len(below) <= most:
                        below[parent] = [(text, production, at)]
                        (above if self.find(parent) is None else reached).append(parent)
            layer = above
        return below, reached

    def levels(self) -> list[list[int]]:
        """The nodes that the root leads to, by the fewest productions it takes."""
        found, layer, met = [], [ROOT], {ROOT}
        while layer:
            found.append(layer)
            below = dict.fromkeys(child for node in layer for child in self.edges.children(node))
            layer = [child for child in below if child not in met]
            met.update(layer)
        return found


class Tree(Dag):
    """A search tree in the place of the DAG: every way to a form has a node of its own."""

    def after(self, parent: int, place: int, production: int) -> int:
        """The edge to a new node below the parent."""
        return self._joined(parent, self._new(self._applied(parent, place, production)), production, place)
