"""A simulator that takes as long as it is told and knows nothing: what a run costs besides is the framework's."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np
from attrs import frozen

from grammarbt.domain import ActionType, ConditionType, Group, Outcome, Reference, Vocabulary

if TYPE_CHECKING:
    from grammarbt.bt import Policy
    from grammarbt.domain import Scenarios


def _group(name: str) -> Group:
    actions = tuple(ActionType(f"{verb} {name}") for verb in ("fetch", "drop"))
    return Group(name, actions, (ConditionType(f"at {name}"), ConditionType(f"holding {name}")))


def _large_group(name: str) -> Group:
    verbs, states = ("fetch", "drop", "wash", "dry"), ("at", "holding", "clean", "near")
    actions = tuple(ActionType(f"{verb} {name}") for verb in verbs)
    return Group(name, actions, tuple(ConditionType(f"{state} {name}") for state in states))


@frozen
class Clockwork:
    """Returns depend on the scenario alone.

    Attributes:
        seconds: what an episode takes.
        busy: whether that keeps the processor busy, or is spent asleep.
    """

    seconds: float = 0.0
    busy: bool = True
    vocabulary = Vocabulary(tuple(_group(name) for name in ("cup", "plate", "spoon", "fork")))
    grammar = "scheide"
    references: ClassVar[tuple[Reference, ...]] = ()
    depends_on: ClassVar[Literal["behaviour", "tree"]] = "behaviour"

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Let the time pass."""
        if self.busy:
            end = time.perf_counter() + self.seconds * len(scenarios)
            while time.perf_counter() < end:
                pass
        else:
            time.sleep(self.seconds * len(scenarios))
        returns = (scenarios * 7919 % 997).astype(np.float64)
        return Outcome(returns, np.ones(policy.occurrences, dtype=np.int64))


class LargeClockwork(Clockwork):
    """Groups whose sub-trees are too many to list."""

    vocabulary = Vocabulary(tuple(_large_group(name) for name in ("cup", "plate", "spoon", "fork")))
