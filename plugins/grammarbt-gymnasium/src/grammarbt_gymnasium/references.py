"""Trees written by hand, to compare with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.bt import Condition, Node, format_tree, leaves, parse, rebuild
from grammarbt.domain import Reference, Vocabulary
from grammarbt_gymnasium.conditions import PARAMETER

if TYPE_CHECKING:
    from collections.abc import Mapping

BY_HAND: Mapping[str, str] = {
    # Push against a swing; if there is none, push under the pole.
    "CartPole": """?( →( (pole velocity above(value=0.4)) [push right] )
                      →( !(pole velocity above(value=-0.4)) [push left] )
                      →( (pole angle above(value=0)) [push right] )
                      [push left] )""",
    # Push the way the car rolls, and back from the right hillside while it is slow.
    "MountainCar": """?( →( !(velocity above(value=-0.003)) [push left] )
                         →( !(velocity above(value=0.008)) (position above(value=-0.45)) [push left] )
                         [push right] )""",
    # Drive the joint against the swing of the first link.
    "Acrobot": "?( →( (velocity 1 above(value=0)) [torque left] ) [torque right] )",
    # Stay upright, and brake.
    "LunarLander": """?( →( (left leg above(value=0.5)) [do nothing] )
                         →( (angle above(value=0.1)) [fire right engine] )
                         →( !(angle above(value=-0.1)) [fire left engine] )
                         →( !(y velocity above(value=-0.3)) [fire main engine] )
                         [do nothing] )""",
    # On the small lake, always go where a slip does no harm.
    "FrozenLake": """?( →( (row is(value=0)) (column above(value=0)) [go up] )
                        →( !(row above(value=1)) [go left] )
                        →( (row is(value=2)) (column is(value=0)) [go up] )
                        →( (row is(value=2)) (column is(value=2)) [go left] )
                        →( (row is(value=3)) (column is(value=1)) [go right] )
                        [go down] )""",
    # Go east or west first; where a wall is in the way, through the row in the middle, which has none.
    "Taxi": """?( →( (at target) ?( →( (passenger is(value=taxi)) [drop off] ) [pick up] ) )
                  →( (target east) !(wall east) [go east] )
                  →( (target west) !(wall west) [go west] )
                  →( ?( (target east) (target west) ) ?( →( (row above(value=2)) [go north] ) [go south] ) )
                  →( (target north) [go north] )
                  [go south] )""",
    # Along the walls until the goal is ahead.
    "MiniGrid-Empty": """?( →( ?( (front is(value=nothing)) (goal is(value=ahead)) ) [move forward] )
                            →( (goal is(value=left)) [turn left] )
                            [turn right] )""",
}
"""By the beginning of an environment's name."""


def references_for(name: str, vocabulary: Vocabulary) -> tuple[Reference, ...]:
    """The tree written for an environment, with the vocabulary's nearest thresholds; none if leaves are missing."""
    text = next((tree for beginning, tree in BY_HAND.items() if name.startswith(beginning)), None)
    if text is None:
        return ()
    tree = rebuild(parse(text), lambda node: _nearest(node, vocabulary))
    known = all(leaf in vocabulary.index for leaf in leaves(tree))
    return (Reference("by hand", format_tree(tree)),) if known else ()


def _nearest(node: Node, vocabulary: Vocabulary) -> Node:
    if not isinstance(node, Condition) or node in vocabulary.index:
        return node
    alike = [leaf for leaf in vocabulary.leaves if isinstance(leaf, Condition) and leaf.name == node.name]
    return min(alike, key=lambda leaf: abs(_value(leaf) - _value(node)), default=node)


def _value(condition: Condition) -> float:
    return float(dict(condition.arguments)[PARAMETER])
