"""The ant on its trail, compiled.

The rules of time. Every action takes one step and then succeeds, so that a sequence of actions is done in one tick: that
is what makes Koza's programs trees, with a sequence for `progn` and a fallback for `if-food-ahead`. A tick in which
nothing took a step costs one. The episode ends with the last step, also in the middle of a tick.
"""

from __future__ import annotations

from grammarbt_toys.program import FAILURE, SUCCESS, Program, cached, compiled
from grammarbt_toys.trail import Food

LEAVES = ("turn left", "turn right", "move forward", "food ahead")
"""What the kernel knows; a leaf's place here is its number in the vocabulary."""

TURN_LEFT, TURN_RIGHT, MOVE_FORWARD, FOOD_AHEAD = range(4)
EAST = 0
"""Headings count clockwise: east, south, west, north."""


@cached
def simulate(program: Program, food: Food, steps: int) -> int:
    """Run an episode from (0, 0), facing east.

    Args:
        program: what the ant does, over leaves as in `LEAVES`.
        food: (rows, columns) where pellets lie; the eaten ones are taken away.
        steps: how many steps the episode has.

    Returns:
        The pellets eaten.
    """
    row, column, heading = 0, 0, EAST
    step, eaten = 0, 0
    while step < steps:
        before, at = step, 0
        while at >= 0 and step < steps:
            leaf = program.leaf[at]
            program.ticks[program.occurrence[at]] += 1
            ahead = _ahead(food, row, column, heading)
            status = SUCCESS
            if leaf == FOOD_AHEAD:
                status = SUCCESS if food[ahead] else FAILURE
            elif leaf == MOVE_FORWARD:
                row, column = ahead
                eaten += food[ahead]
                food[ahead] = False
            else:
                heading = (heading + (1 if leaf == TURN_RIGHT else -1)) % 4
            step += leaf != FOOD_AHEAD
            at = program.follow[at, status]
        step += step == before
    return eaten


@compiled
def _ahead(food: Food, row: int, column: int, heading: int) -> tuple[int, int]:
    """The cell in front of the ant; the world is a torus."""
    rows, columns = food.shape
    if heading % 2 == 0:
        return row, (column + 1 - heading) % columns
    return (row + 2 - heading) % rows, column
