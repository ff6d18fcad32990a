"""A simulator in plain Python: say what a leaf does, and the ticking is done for you."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np

from grammarbt.bt import Action, FlatTree, Leaf, Policy, Status, flatten, tick
from grammarbt.domain.base import Outcome, Reference, Scenarios

if TYPE_CHECKING:
    from grammarbt.bt.vocabulary import Vocabulary


class TickDomain(ABC):
    """Base of domains written as a world with a state.

    Each episode: `reset(rng)`, then ticks until `done`; after each tick `step()` lets the world move on. The return is
    `reward` at the end.
    """

    vocabulary: ClassVar[Vocabulary]
    grammar: ClassVar[str] = "general"
    references: ClassVar[tuple[Reference, ...]] = ()
    depends_on: ClassVar[Literal["behaviour", "tree"]] = "behaviour"

    reward: float = 0.0
    done: bool = False

    @abstractmethod
    def reset(self, rng: np.random.Generator) -> None:
        """Make a fresh world; draw all that is random from `rng`, also later in the episode."""

    @abstractmethod
    def condition(self, name: str, **arguments: str) -> bool:
        """Whether the condition holds now."""

    @abstractmethod
    def action(self, name: str, **arguments: str) -> Status:
        """Do one step of the action and say how it went."""

    @abstractmethod
    def step(self) -> None:
        """Let time pass after a tick; set `done` when the episode is over."""

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Run one episode per scenario."""
        flat = flatten(policy.tree)
        ticks = np.zeros(flat.occurrences, dtype=np.int64)
        returns = np.array([self._episode(flat, int(scenario), ticks) for scenario in scenarios], dtype=np.float64)
        return Outcome(returns, ticks)

    def _episode(self, flat: FlatTree, scenario: int, ticks: np.ndarray[tuple[int], np.dtype[np.int64]]) -> float:
        def answer(leaf: Leaf, occurrence: int) -> Status:
            ticks[occurrence] += 1
            return self._answer(leaf)

        self.reward, self.done = 0.0, False
        self.reset(np.random.default_rng(scenario))
        while not self.done:
            tick(flat, answer)
            self.step()
        return self.reward

    def _answer(self, leaf: Leaf) -> Status:
        arguments = dict(leaf.arguments)
        if isinstance(leaf, Action):
            return self.action(leaf.name, **arguments)
        return Status.SUCCESS if self.condition(leaf.name, **arguments) else Status.FAILURE
