"""The artificial ant (Koza, *Genetic Programming*, 1992): eat as many pellets of the Santa Fe trail as possible.

The trail winds over a torus of 32 × 32 cells, with gaps and corners; the ant sees only the cell ahead.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from grammarbt.bt import Status
from grammarbt.domain import ActionType, ConditionType, Group, Outcome, Reference, Vocabulary
from grammarbt.domain.plain import record
from grammarbt_toys import ant_kernel
from grammarbt_toys.parameters import AntParameters
from grammarbt_toys.plain_ant import PlainAnt
from grammarbt_toys.program import make_program
from grammarbt_toys.trail import santa_fe_rows, santa_fe_trail

if TYPE_CHECKING:
    from grammarbt.bt import Policy
    from grammarbt.domain import Episode, Scenarios

_DONE = frozenset({Status.SUCCESS})
VOCABULARY = Vocabulary(
    (
        Group(
            "ant",
            actions=(
                ActionType("turn left", "Turn a quarter to the left; takes one step.", results=_DONE),
                ActionType("turn right", "Turn a quarter to the right; takes one step.", results=_DONE),
                ActionType("move forward", "Move to the cell ahead and eat what is there; one step.", results=_DONE),
            ),
            conditions=(ConditionType("food ahead", "A pellet lies in the cell ahead."),),
        ),
    )
)

_STEP_OR_LEFT = "?( →( (food ahead) [move forward] ) [turn left] )"
_STEP_OR_RIGHT = "?( →( (food ahead) [move forward] ) [turn right] )"
_LOOK_AROUND = f"→( [turn left] {_STEP_OR_RIGHT} [turn right] [turn left] [turn right] {_STEP_OR_LEFT} [move forward] )"


class Ant:
    """The ant on the Santa Fe trail; all scenarios are the same."""

    vocabulary = VOCABULARY
    grammar = "ant"
    references = (Reference("Koza", f"?( →( (food ahead) [move forward] ) {_LOOK_AROUND} )"),)
    depends_on: Literal["behaviour", "tree"] = "behaviour"
    return_range = (0.0, 89.0)

    def __init__(self, parameters: AntParameters | None = None) -> None:
        self.parameters = parameters or AntParameters()

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Run one episode; the same for every scenario."""
        program = make_program(policy)
        eaten = ant_kernel.simulate(program, santa_fe_trail().copy(), self.parameters.steps)
        return Outcome(np.full(len(scenarios), float(eaten)), program.ticks * len(scenarios))

    def episode(self, policy: Policy, _scenario: int) -> Episode:
        """The episode that `simulate` scores."""
        world = PlainAnt(santa_fe_rows(), self.parameters.steps)
        return record(world, policy.tree, world.box, "pellets")
