"""Trees written by hand, to compare with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.bt import Condition, Node, format_tree, leaves, parse, rebuild
from grammarbt.domain import Reference, Vocabulary
from grammarbt_gymnasium.conditions import PARAMETER

if TYPE_CHECKING:
    from collections.abc import Mapping

BY_HAND: Mapping[str, str] = {
    "CartPole": """?( →( (pole velocity above(value=0.4)) [push right] )
                      →( !(pole velocity above(value=-0.4)) [push left] )
                      →( (pole angle above(value=0)) [push right] )
                      [push left] )""",
    "MountainCar": """?( →( !(velocity above(value=-0.003)) [push left] )
                         →( !(velocity above(value=0.008)) (position above(value=-0.45)) [push left] )
                         [push right] )""",
    "Acrobot": """?( →( (velocity 1 above(value=0)) [torque left] ) [torque right] )""",
}
"""CartPole: push against a swing, and if there is none, under the pole. MountainCar: push the way the car rolls, and back
from the right hillside while it is slow. Acrobot: drive the joint against the swing of the first link."""


def references_for(name: str, vocabulary: Vocabulary) -> tuple[Reference, ...]:
    """The tree written for an environment, with the vocabulary's nearest thresholds; none if leaves are missing."""
    if name not in BY_HAND:
        return ()
    tree = rebuild(parse(BY_HAND[name]), lambda node: _nearest(node, vocabulary))
    known = all(leaf in vocabulary.index for leaf in leaves(tree))
    return (Reference("by hand", format_tree(tree)),) if known else ()


def _nearest(node: Node, vocabulary: Vocabulary) -> Node:
    if not isinstance(node, Condition):
        return node
    alike = [leaf for leaf in vocabulary.leaves if isinstance(leaf, Condition) and leaf.name == node.name]
    return min(alike, key=lambda leaf: abs(_value(leaf) - _value(node)), default=node)


def _value(condition: Condition) -> float:
    return float(dict(condition.arguments)[PARAMETER])
