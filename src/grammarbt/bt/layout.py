"""Where the nodes of a drawing stand: children in a row below their parent, who stands above their middle."""

from __future__ import annotations

from unicodedata import east_asian_width

from attrs import frozen

from grammarbt.bt.model import Action, BehaviorTree, Condition, Node, leaf_text, numbered
from grammarbt.bt.notation import operator

HEIGHT, GAP, LEVEL = 30.0, 16.0, 62.0
"""Height of a node, space between neighbours, and distance of two levels, in pixels."""

_LETTER, _WIDE_LETTER, _PADDING = 7.2, 13.0, 18.0


@frozen
class Placed:
    """A node of a drawing.

    Attributes:
        node: what is drawn.
        text: what stands in it.
        x, y: its middle, in pixels from the drawing's top left corner.
        width: in pixels.
        parent: its parent's place in the drawing's list, or None.
    """

    node: Node
    text: str
    x: float
    y: float
    width: float
    parent: int | None


@frozen
class Drawing:
    """Placed nodes in pre-order, and the size of the whole in pixels."""

    nodes: tuple[Placed, ...]
    width: float
    height: float


def lay_out(tree: BehaviorTree) -> Drawing:
    """Place a tree's nodes; no two overlap."""
    nodes = numbered(tree)
    texts = [leaf_text(node) if isinstance(node, Action | Condition) else operator(node) for node, _ in nodes]
    boxes = [_width(text) for text in texts]
    levels = [0] * len(nodes)
    for at, (_, parent) in enumerate(nodes):
        levels[at] = 0 if parent is None else levels[parent] + 1
    xs, total = _across(nodes, boxes)
    placed = tuple(
        Placed(node, texts[at], xs[at], levels[at] * LEVEL + HEIGHT / 2 + GAP, boxes[at], parent)
        for at, (node, parent) in enumerate(nodes)
    )
    return Drawing(placed, total, max(levels) * LEVEL + HEIGHT + 2 * GAP)


def _across(nodes: list[tuple[Node, int | None]], boxes: list[float]) -> tuple[list[float], float]:
    """The middle of each node, and the width of the drawing: every sub-tree has a column of its own."""
    inside = [0.0] * len(nodes)
    columns = list(boxes)
    for at in reversed(range(len(nodes))):
        columns[at] = max(boxes[at] + GAP, inside[at])
        parent = nodes[at][1]
        if parent is not None:
            inside[parent] += columns[at]
    lefts, xs = [GAP / 2] * len(nodes), [0.0] * len(nodes)
    nexts = list(lefts)
    for at, (_, parent) in enumerate(nodes):
        if parent is not None:
            lefts[at] = nexts[parent]
            nexts[parent] += columns[at]
        xs[at] = lefts[at] + columns[at] / 2
        nexts[at] = lefts[at] + (columns[at] - inside[at]) / 2
    return xs, columns[0] + GAP


def _width(text: str) -> float:
    letters = sum(_WIDE_LETTER if east_asian_width(char) in "WF" else _LETTER for char in text)
    return max(HEIGHT, letters + _PADDING)
