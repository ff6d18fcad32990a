"""Distinct names for the nodes of a tree, for libraries that ask for them."""

from __future__ import annotations

from collections import Counter

from grammarbt.bt.model import Action, Condition, Fallback, Node, Parallel, Sequence, leaf_text

_CONTROL = {Fallback: "fallback", Sequence: "sequence", Parallel: "parallel"}


class UniqueNames:
    """Hands out names: a leaf's own, a control node's kind; the second of a name is `name (2)`.

    No leaf's own name ends like that, so nothing collides.
    """

    def __init__(self) -> None:
        self.given: Counter[str] = Counter()

    def name(self, node: Node) -> str:
        """The next free name for the node."""
        text = _label(node)
        self.given[text] += 1
        return text if self.given[text] == 1 else f"{text} ({self.given[text]})"


def _label(node: Node) -> str:
    """A leaf as it stands between its brackets, or the kind of a control node."""
    if isinstance(node, Action | Condition):
        return leaf_text(node)
    return _CONTROL.get(type(node), "not")
