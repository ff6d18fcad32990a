"""A running program: lines go in, lines come out, and nothing takes longer than it may."""

from __future__ import annotations

import contextlib
import os
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from selectors import EVENT_READ, EVENT_WRITE, DefaultSelector
from typing import IO, cast

from grammarbt.errors import DomainError
from grammarbt_exec import guard
from grammarbt_exec.lines import shown

MAX_LINE = 16 * 2**20
"""Bytes of the longest line that is read."""

_PIECE = 2**16
_MOST_PIECES = 64
"""Of standard error that are read at the end, or before a request; there can be more only while somebody writes."""

_TAIL = 2_000
_LAST_LINES = 5
_PATIENCE = 0.5
"""Seconds that a program which has closed its standard output gets to say, by ending, why."""


class ProgramError(DomainError):
    """A program died, was too slow, or said what it must not; it has been ended."""


class Program:
    """A program from its start to its end; one thread may use it.

    Args:
        command: the program and its arguments, quoted as for a shell.

    Raises:
        DomainError: there is no such program.
    """

    def __init__(self, command: str) -> None:
        self._command = command
        words = _words(command)
        self._lifeline, theirs = socket.socketpair()
        self._process = subprocess.Popen(  # noqa: S603 - the command is what the user asked for
            [sys.executable, "-I", "-S", str(Path(guard.__file__)), str(theirs.fileno()), *words],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            bufsize=0,
            pass_fds=(theirs.fileno(),),
            start_new_session=True,
        )
        theirs.close()
        streams = (self._process.stdin, self._process.stdout, self._process.stderr)
        self._input, self._output, self._errors = (cast("IO[bytes]", stream).fileno() for stream in streams)
        self._unsent, self._received, self._tail = memoryview(b""), bytearray(), b""
        self._selector = DefaultSelector()
        for stream, reader in ((self._output, self._receive), (self._errors, self._collect)):
            self._selector.register(stream, EVENT_READ, reader)
        os.set_blocking(self._input, False)

    @property
    def ended(self) -> bool:
        """Whether it has been ended; it may have died without our knowing."""
        return self._lifeline.fileno() < 0

    def exchange(self, request: bytes, limit: float) -> bytes:
        """Send a request and wait for one line.

        Args:
            request: a line, or nothing.
            limit: seconds that both together may take.

        Returns:
            The line without its end.

        Raises:
            ProgramError: the program did not answer with one line in time.
        """
        if request:
            self._forget_errors()
            self._unsent = memoryview(request)
            self._selector.register(self._input, EVENT_WRITE, self._send)
        try:
            return self._line(time.monotonic() + limit, limit)
        except KeyboardInterrupt:
            self._kill()
            self.end()  # its answer would be taken for that to the next request
            raise

    def fault(self, what: str) -> ProgramError:
        """The error that says what the program did, with the last lines of its standard error; ends the program."""
        self._kill()
        self._read_last_errors()
        self.end()
        lines = self._tail.decode(errors="replace").splitlines()[-_LAST_LINES:]
        ending = f"; its standard error ends with: {' | '.join(lines)}" if lines else ""
        return ProgramError(f"the program {self._command!r} {what}{ending}")

    def end(self) -> None:
        """Hang up, and wait until the program and all that it has started have ended."""
        if not self.ended:
            self._selector.close()
            for stream in (self._process.stdin, self._process.stdout, self._process.stderr):
                cast("IO[bytes]", stream).close()
            self._lifeline.close()
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(guard.GRACE + _PATIENCE)
            self._kill()

    def _line(self, deadline: float, limit: float) -> bytes:
        searched = 0
        while (end := self._received.find(b"\n", searched)) < 0:
            searched = len(self._received)
            if searched > MAX_LINE:
                raise self.fault(f"wrote a line longer than {MAX_LINE // 2**20} MiB")
            left = deadline - time.monotonic()  # who only writes errors, or dribbles, is too slow as well
            ready = self._selector.select(left) if left > 0 else []
            if not ready:
                partly = f", only began: {shown(bytes(self._received))}" if self._received else ""
                raise self.fault(f"did not answer within {limit:g} s{partly}")
            for key, _ in ready:
                key.data()
        line, rest = bytes(self._received[:end]), bytes(self._received[end + 1 :])
        if self._unsent:
            raise self.fault(f"answered before it had read the request: {shown(line)}")
        if rest:
            raise self.fault(f"wrote more than one line at once, after the first: {shown(rest)}")
        self._received.clear()
        return line

    def _send(self) -> None:
        try:
            sent = os.write(self._input, self._unsent[:_PIECE])
        except BrokenPipeError:
            sent = len(self._unsent)  # what its standard output does then says more
        self._unsent = self._unsent[sent:]
        if not self._unsent:
            self._selector.unregister(self._input)

    def _receive(self) -> None:
        piece = os.read(self._output, _PIECE)
        if not piece:
            raise self._hung_up()
        self._received += piece

    def _collect(self) -> bool:
        """Read some of the standard error; whether there may be more."""
        piece = os.read(self._errors, _PIECE)
        if not piece:
            self._selector.unregister(self._errors)
        self._tail = (self._tail + piece)[-_TAIL:]
        return bool(piece)

    def _hung_up(self) -> ProgramError:
        try:
            self._process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            return self.fault("closed its standard output")
        code = int(self._lifeline.recv(16) or -signal.SIGKILL)
        if code < 0:
            return self.fault(f"was ended by signal {-code} ({signal.strsignal(-code)})")
        return self.fault("could not be started" if code == guard.NOT_STARTED else f"ended with exit code {code}")

    def _forget_errors(self) -> None:
        """What was written before belongs to an earlier request, which may have been another worker's."""
        self._read_last_errors(0)
        self._tail = b""

    def _read_last_errors(self, patience: float = _PATIENCE) -> None:
        with DefaultSelector() as selector:
            if self._errors in self._selector.get_map():
                selector.register(self._errors, EVENT_READ)
            for _ in range(_MOST_PIECES):
                if not selector.get_map() or not selector.select(patience) or not self._collect():
                    break

    def _kill(self) -> None:
        with contextlib.suppress(ProcessLookupError, PermissionError):  # the latter, on macOS, for what has ended
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()


def _words(command: str) -> list[str]:
    try:
        words = shlex.split(command)
    except ValueError as error:
        raise DomainError(f"cannot read the command {command!r}: {error}", "quote it as for a shell") from None
    if not words or shutil.which(words[0]) is None:
        hint = "give the path of an executable file, for example ./simulator"
        raise DomainError(f"there is no program {(words or [command])[0]!r} that can be run", hint)
    return words
