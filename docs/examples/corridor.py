"""A robot in a corridor: fetch the cup from some cell and bring it to the door, in 40 steps.

grammarbt run --domain docs/examples/corridor.py:Corridor --searcher random --budget 2000
"""

import numpy as np

from grammarbt.bt import Status
from grammarbt.domain import ActionType, ConditionType, Group, Reference, TickDomain, Vocabulary

GRIP, STEPS = 0.8, 40


class Corridor(TickDomain):
    vocabulary = Vocabulary(
        (
            Group("fetch", (ActionType("go to cup"), ActionType("grasp")), (ConditionType("at cup"),)),
            Group("deliver", (ActionType("go to door"),), (ConditionType("holding cup"),)),
        )
    )
    grammar = "scheide"
    references = (Reference("manual", "?( →( (holding cup) [go to door] ) →( [go to cup] [grasp] ) )"),)

    def reset(self, rng: np.random.Generator) -> None:
        self.rng, self.robot, self.cup, self.holding, self.time = rng, 0, int(rng.integers(2, 8)), False, 0

    def condition(self, name: str) -> bool:
        return self.holding if name == "holding cup" else self.robot == self.cup

    def action(self, name: str) -> Status:
        if name == "grasp":
            self.holding = self.holding or (self.robot == self.cup and self.rng.random() < GRIP)
            return Status.SUCCESS if self.holding else Status.FAILURE
        goal = self.cup if name == "go to cup" else 0
        self.robot += (goal > self.robot) - (goal < self.robot)
        return Status.SUCCESS if self.robot == goal else Status.RUNNING

    def step(self) -> None:
        self.time += 1
        delivered = self.holding and self.robot == 0
        self.done = delivered or self.time == STEPS
        self.reward = 40 * delivered + 10 * self.holding - self.time
