"""A world small enough to reason about: two switches, each with a lamp; and a searcher that proposes what it is told."""

import pytest

from grammarbt.bt import Status, parse
from grammarbt.domain import ActionType, ConditionType, Group, Reference, TickDomain, Vocabulary
from grammarbt.search import Proposal


class Lamps(TickDomain):
    """Each lamp that is lit at the end pays; the scenario decides how much."""

    vocabulary = Vocabulary(
        (
            Group("left", (ActionType("light left"),), (ConditionType("left lit"),)),
            Group("right", (ActionType("light right"),), (ConditionType("right lit"),)),
        )
    )
    grammar = "scheide"
    references = (
        Reference(
            "both",
            "?( →( ?( (left lit) [light left] ) !(left lit) ) →( ?( (right lit) [light right] ) !(right lit) ) )",
        ),
    )

    def reset(self, rng):
        self.lit, self.pay = {"left": False, "right": False}, float(rng.normal(10, 1))

    def condition(self, name):
        return self.lit[name.split()[0]]

    def action(self, name):
        self.lit[name.split()[1]] = True
        return Status.SUCCESS

    def step(self):
        self.done = True
        self.reward = self.pay * sum(self.lit.values())


class Fixed:
    """Proposes the given proposals in order, and keeps what it is told."""

    def __init__(self, proposals):
        self.left, self.told = list(proposals), []

    def ask(self, n):
        batch, self.left = self.left[:n], self.left[n:]
        return batch

    def tell(self, evaluations):
        self.told += evaluations

    def candidates(self, n):
        return [evaluation.proposal.tree for evaluation in self.told][:n]

    def metrics(self):
        return {"told": float(len(self.told))}


@pytest.fixture
def lamps():
    return Lamps


@pytest.fixture
def fixed():
    return Fixed


@pytest.fixture
def proposal():
    return lambda text, start=0, stop=1: Proposal(parse(text), None, start, stop)


@pytest.fixture
def broken():
    """A lamps domain whose simulate is replaced."""

    def make(simulate):
        return type("Broken", (Lamps,), {"simulate": lambda _, policy, scenarios: simulate(policy, scenarios)})()

    return make
