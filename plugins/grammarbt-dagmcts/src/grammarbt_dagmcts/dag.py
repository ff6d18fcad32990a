"""The derivation DAG: sentential forms as nodes, single productions as edges."""

from __future__ import annotations

from collections.abc import Iterable

from attrs import define, field

from grammarbt.grammar import BoundGrammar, SententialForm
from grammarbt.search import Arm


@define(eq=False)
class Node(Arm):
    """A sentential form; its rewards are those of all roll-outs through it, each once.

    Attributes:
        form: what it stands for.
        number: its place in the order of creation.
        parents: nodes that become it by one production.
        children: nodes by number, with the production that leads there.
        untried: (position, production) pairs that no selection took yet; None before the first selection.
        selections: how often selection passed through it, apart from rewards.
        closed: every word below it was proposed.
    """

    form: SententialForm
    number: int
    parents: list[Node] = field(factory=list, init=False, repr=False)
    children: dict[int, tuple[Node, int]] = field(factory=dict, init=False, repr=False)
    untried: list[tuple[int, int]] | None = field(default=None, init=False, repr=False)
    selections: int = field(default=0, init=False)
    closed: bool = field(default=False, init=False)


class Dag:
    """One node per sentential form; every parent in the DAG is joined to its children, whichever came first."""

    def __init__(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self.nodes: list[Node] = []
        self.by_form: dict[SententialForm, Node] = {}
        self.edges = 0
        self._absent: dict[SententialForm, list[tuple[Node, int]]] = {}
        self.root = self.add(grammar.start())

    def child(self, parent: Node, production: int, position: int | None = None) -> Node:
        """The node after a production at a position (default: leftmost), which may have been there before."""
        form = self.grammar.apply(parent.form, production, position)
        return self.by_form.get(form) or self.add(form)

    def add(self, form: SententialForm) -> Node:
        """A new node, joined to all its parents and children in the DAG."""
        node = self.by_form[form] = self._new(form)
        for child, production in self._absent.pop(form, ()):
            self._join(node, child, production)
        for above, production in self.grammar.parents(form):
            parent = self.by_form.get(above)
            if parent is None:
                self._absent.setdefault(above, []).append((node, production))
            else:
                self._join(parent, node, production)
        return node

    def _new(self, form: SententialForm) -> Node:
        node = Node(form, len(self.nodes))
        self.nodes.append(node)
        return node

    def _join(self, parent: Node, child: Node, production: int) -> None:
        if child.number not in parent.children:
            parent.children[child.number] = (child, production)
            child.parents.append(parent)
            self.edges += 1

    def link_ancestors(self, node: Node, k: int, most: int) -> None:
        """Join the node to its ancestors in the DAG within k inverse productions, by adding the forms between.

        At most `most` forms are looked at.
        """
        below, reached = self._search_above(node, k, most)
        pending = [form for above in reached for form in below[above]]
        while pending:
            form = pending.pop()
            if form not in self.by_form:
                self.add(form)
                pending.extend(below[form])

    def _search_above(
        self, node: Node, k: int, most: int
    ) -> tuple[dict[SententialForm, list[SententialForm]], list[SententialForm]]:
        """The forms above the node, each with those it leads to, and which of them the DAG has."""
        below: dict[SententialForm, list[SententialForm]] = {node.form: []}
        reached: list[SententialForm] = []
        layer = [node.form]
        for _ in range(k):
            above: list[SententialForm] = []
            for form in layer:
                for parent, _ in self.grammar.parents(form):
                    if parent in below:
                        below[parent].append(form)
                    elif len(below) <= most:
                        below[parent] = [form]
                        (reached if parent in self.by_form else above).append(parent)
            layer = above
        return below, reached

    def close(self, node: Node) -> None:
        """Mark a node as having nothing left to propose, and every ancestor of which this is then true."""
        pending = [node]
        while pending:
            done = pending.pop()
            done.closed = True
            pending.extend(parent for parent in done.parents if not parent.closed and _exhausted(parent))


class Tree(Dag):
    """A search tree in the place of the DAG: every way to a form has a node of its own."""

    def child(self, parent: Node, production: int, position: int | None = None) -> Node:
        """A new node below the parent."""
        node = self._new(self.grammar.apply(parent.form, production, position))
        self._join(parent, node, production)
        return node


def ancestors(nodes: Iterable[Node]) -> list[Node]:
    """The nodes and all their ancestors, each once, nearest first."""
    found = {node.number: node for node in nodes}
    order = list(found.values())
    for node in order:  # grows while it is read
        for parent in node.parents:
            if parent.number not in found:
                found[parent.number] = parent
                order.append(parent)
    return order


def levels(root: Node) -> list[list[Node]]:
    """The nodes that the root leads to, by the fewest productions it takes."""
    met = {root.number}
    found, layer = [], [root]
    while layer:
        found.append(layer)
        below: list[Node] = []
        for node in layer:
            below.extend(child for child, _ in node.children.values() if child.number not in met)
            met.update(node.children)
        layer = list(dict.fromkeys(below))
    return found


def _exhausted(node: Node) -> bool:
    return node.untried == [] and all(child.closed for child, _ in node.children.values())
