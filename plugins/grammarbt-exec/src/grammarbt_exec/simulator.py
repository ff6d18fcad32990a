"""A program that is asked one thing after another, whatever becomes of it in between."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from grammarbt_exec.announcement import read_announcement
from grammarbt_exec.lines import shown
from grammarbt_exec.program import Program

if TYPE_CHECKING:
    from grammarbt_exec.announcement import Announcement
    from grammarbt_exec.messages import Answer, Request
    from grammarbt_exec.parameters import ExecParameters

Found = TypeVar("Found")


class Simulator:
    """A program that is started once, and anew after it has died, hung or talked nonsense.

    Args:
        parameters: which program, and how long it may take.

    Attributes:
        announced: what it said about itself.

    Raises:
        DomainError: the program cannot be started, or does not announce itself.
    """

    def __init__(self, parameters: ExecParameters) -> None:
        self._parameters = parameters
        self.announced = self._start()

    def ask(self, request: Request, read: Callable[[Answer], Found]) -> Found:
        """Send a request, and read its answer.

        Args:
            request: what to ask.
            read: gives what is in an answer; a ValueError says why that is not there.

        Raises:
            DomainError: the program refused.
            ProgramError: it did not answer as it must; the next call starts it anew.
        """
        if self._program.ended:
            self._restart()
        line = self._program.exchange(request.line, self._parameters.timeout)
        try:
            return read(request.answer(line))
        except ValueError as error:
            raise self._program.fault(f"did not answer the request: {error}: {shown(line)}") from None

    def end(self) -> None:
        """End the program; asking again starts it anew."""
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
        if self._start() != self.announced:
            raise self._program.fault("announced something else than when it was first started")
