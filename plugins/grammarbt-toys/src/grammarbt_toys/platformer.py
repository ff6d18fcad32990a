"""A platform game: a player runs through a level, over gaps and walls and past enemies, as far as it can.

With the kinds of leaves that Perez, Nicolau, O'Neill and Brabazon used ("Evolving Behaviour Trees for the Mario AI
Competition Using Grammatical Evolution", EvoApplications 2011): buttons, and conditions on the cells around the player.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from grammarbt.bt import Status
from grammarbt.domain import ActionType, ConditionType, Group, Outcome, Reference, Vocabulary
from grammarbt.domain.plain import record
from grammarbt_toys import platformer_kernel as kernel
from grammarbt_toys.parameters import PlatformerParameters
from grammarbt_toys.plain_platformer import PlainGame, draw_level
from grammarbt_toys.program import make_program

if TYPE_CHECKING:
    from grammarbt.bt import Policy
    from grammarbt.domain import Episode, Scenarios

_FIELD = (("right", tuple(map(str, kernel.RIGHTS))), ("up", tuple(map(str, kernel.UPS))))
_PRESSED = frozenset({Status.SUCCESS})

VOCABULARY = Vocabulary(
    (
        Group(
            "player",
            actions=tuple(
                ActionType(button, f"Press the button '{button}' in this step.", results=_PRESSED)
                for button in kernel.BUTTONS
            ),
            conditions=(
                ConditionType("on ground", "The player stands, and can jump."),
                ConditionType("can shoot", "The player's weapon is loaded."),
                ConditionType("solid", "The cell so far from the player is ground or wall.", _FIELD),
                ConditionType("enemy", "The cell so far from the player holds an enemy.", _FIELD),
            ),
        ),
    )
)

_BEAT_ENEMIES = " ".join(f"→( (enemy(right={cells},up=0)) [shoot] )" for cells in range(1, 5))
_CLIMB = "→( (solid(right=1,up=0)) [jump] [right] )"
_LEAP = "→( (solid(right=-1,up=-1)) !(solid(right=1,up=-1)) [jump] [right] )"
"""On a wall the ground behind is low too, and there is no need to leap."""


class Platformer:
    """How far a player comes; the level depends on the scenario, and nothing else is chance."""

    vocabulary = VOCABULARY
    grammar = "perez"
    references = (
        Reference("manual", f"?( {_BEAT_ENEMIES} {_CLIMB} {_LEAP} [right] )"),
        Reference("without shooting", f"?( {_CLIMB} {_LEAP} [right] )"),
    )
    depends_on: Literal["behaviour", "tree"] = "behaviour"

    def __init__(self, parameters: PlatformerParameters | None = None) -> None:
        self.parameters = parameters or PlatformerParameters()
        self.return_range = 0.0, self.parameters.columns - 1.0

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Run one episode per scenario; the return is the columns that the player came forward."""
        program, numbers = make_program(policy), np.array(scenarios, dtype=np.int64)
        world = make_world(self.parameters.columns)
        return Outcome(kernel.simulate(program, world, self.parameters.steps, numbers), program.ticks)

    def episode(self, policy: Policy, scenario: int) -> Episode:
        """The episode that `simulate` scores."""
        game = PlainGame(draw_level(scenario, self.parameters.columns), self.parameters.steps)
        return record(game, policy.tree, game.box, "columns")


def make_world(columns: int) -> kernel.World:
    """Room for a level, to be filled when an episode begins."""
    room = (np.zeros(size, dtype=np.int64) for size in (columns, columns, columns, kernel.RELOADING + 1))
    return kernel.World(*room)
