"""The domain `exec`: asks a program for the returns of trees, and for episodes if it tells them."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from grammarbt.bt import Policy
from grammarbt.domain import Episode, Outcome, Scenarios
from grammarbt_exec.episodes import episode_of, showing
from grammarbt_exec.messages import outcome_of, simulation
from grammarbt_exec.simulator import Simulator

if TYPE_CHECKING:
    from grammarbt_exec.parameters import ExecParameters


def make_exec(parameters: ExecParameters) -> Exec:
    """Start the program; the domain can be watched if the program says so.

    Args:
        parameters: which program, and how long it may take.

    Raises:
        DomainError: the program cannot be started, or does not announce itself.
    """
    simulator = Simulator(parameters)
    return (WatchableExec if simulator.announced.episodes else Exec)(simulator)


class Exec:
    """A program as a domain.

    Args:
        simulator: the program.
    """

    def __init__(self, simulator: Simulator) -> None:
        self._simulator = simulator
        self.vocabulary = simulator.announced.vocabulary()
        self.grammar = simulator.announced.grammar
        self.references = simulator.announced.references
        self.depends_on = simulator.announced.depends_on

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Ask the program for returns.

        Raises:
            DomainError: it refused the tree.
            ProgramError: it did not answer as it must; the next call starts it anew.
        """
        if not len(scenarios):
            return Outcome(np.zeros(0), np.zeros(policy.occurrences, dtype=np.int64))
        read = partial(outcome_of, policy=policy, scenarios=scenarios)
        return self._simulator.ask(simulation(policy, scenarios), read)

    def close(self) -> None:
        """End the program; simulating again starts it anew."""
        self._simulator.end()


class WatchableExec(Exec):
    """A program that tells episodes."""

    def episode(self, policy: Policy, scenario: int) -> Episode:
        """Ask the program what happens in a scenario.

        Raises:
            DomainError: it refused the tree.
            ProgramError: it did not answer as it must; the next call starts it anew.
        """
        read = partial(episode_of, policy=policy, vocabulary=self.vocabulary)
        return self._simulator.ask(showing(policy, scenario), read)
