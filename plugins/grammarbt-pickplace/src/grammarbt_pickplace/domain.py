"""The pick and place domain: a task's vocabulary and the compiled simulator, as grammarbt wants them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from grammarbt.domain import Outcome
from grammarbt.domain.plain import record
from grammarbt_pickplace.kernel.episodes import simulate
from grammarbt_pickplace.parameters import PickPlaceParameters
from grammarbt_pickplace.picture import BOX
from grammarbt_pickplace.plain import PlainPickPlace
from grammarbt_pickplace.program import LEAVES, make_program
from grammarbt_pickplace.state import MEMORY, STATE
from grammarbt_pickplace.tasks import TASKS

if TYPE_CHECKING:
    from grammarbt.bt import Policy
    from grammarbt.domain import Episode, Scenarios


class PickPlace:
    """A mobile manipulator fetches cubes from pick tables and puts them on their goal.

    Each node of the tree costs, and each action node has a memory of its own: so the return depends on the tree itself.
    """

    grammar = "pickplace"
    depends_on: Literal["behaviour", "tree"] = "tree"
    return_range = (-np.inf, 0.0)

    def __init__(self, parameters: PickPlaceParameters | None = None) -> None:
        self.parameters = parameters or PickPlaceParameters()
        self._task = TASKS[self.parameters.task]
        self.vocabulary = self._task.vocabulary
        self.references = self._task.references
        self._starts = np.array(self._task.starts)
        self._codes = np.array([LEAVES.index(leaf.name) for leaf in self.vocabulary.leaves], dtype=np.int32)

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Run one episode per scenario; in S2 that is a run per table, and the return their mean."""
        state = np.zeros(1, dtype=STATE)
        state["stochastic"] = self.parameters.stochastic
        memory = np.zeros(policy.occurrences, dtype=MEMORY)
        numbers = np.array(scenarios, dtype=np.int64)  # read-only or strided arrays would be compiled for anew
        program = make_program(policy, self._codes)
        return Outcome(*simulate(program, state, memory, self._starts, numbers))

    def episode(self, policy: Policy, scenario: int) -> Episode:
        """The episode that `simulate` scores; in S2 its runs follow each other, and the reward is their mean so far."""
        world = PlainPickPlace(self._task, policy.tree, scenario, stochastic=self.parameters.stochastic)
        return record(world, policy.tree, BOX, "points")
