"""The domain `exec`: asks a program for the returns of trees."""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING

import numpy as np

from grammarbt.bt import Policy
from grammarbt.domain import Outcome, Scenarios
from grammarbt.errors import DomainError
from grammarbt_exec.announcement import read_announcement
from grammarbt_exec.lines import shown
from grammarbt_exec.messages import Request
from grammarbt_exec.program import Program

if TYPE_CHECKING:
    from grammarbt_exec.announcement import Announcement
    from grammarbt_exec.parameters import ExecParameters


class Exec:
    """A program that is started once, and anew after it has died, hung or talked nonsense.

    Args:
        parameters: which program, and how long it may take.

    Raises:
        DomainError: the program cannot be started, or does not announce itself.
    """

    def __init__(self, parameters: ExecParameters) -> None:
        self._parameters = parameters
        self._announced = self._start()
        self.vocabulary = self._announced.vocabulary()
        self.grammar = self._announced.grammar
        self.references = self._announced.references
        self.depends_on = self._announced.depends_on

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Ask the program.

        Raises:
            DomainError: it refused the tree.
            ProgramError: it did not answer as it must; the next call starts it anew.
        """
        if not len(scenarios):
            return Outcome(np.zeros(0), np.zeros(policy.occurrences, dtype=np.int64))
        if self._program.ended:
            self._restart()
        request = Request(policy, scenarios)
        line = self._program.exchange(request.line, self._parameters.timeout)
        try:
            answer = request.read(line)
        except ValueError as error:
            raise self._program.fault(f"did not answer the request: {error}: {shown(line)}") from None
        if isinstance(answer, str):
            raise DomainError(f"the program refused: {answer}")
        return answer

    def close(self) -> None:
        """End the program; simulating again starts it anew."""
        self._program.end()

    def _start(self) -> Announcement:
        program = self._program = Program(self._parameters.command)
        weakref.finalize(self, program.end)
        line = program.exchange(b"", self._parameters.startup)
        try:
            return read_announcement(line)
        except ValueError as error:
            raise program.fault(f"did not announce itself: {error}: {shown(line)}") from None

    def _restart(self) -> None:
        if self._start() != self._announced:
            raise self._program.fault("announced something else than when it was first started")
