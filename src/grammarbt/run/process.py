"""One worker process, kept within limits by the thread that leads it; a new one takes its place when it ends."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import time
from collections.abc import Callable
from concurrent.futures import BrokenExecutor
from math import inf
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING, TypeAlias, TypeVar, cast

from attrs import frozen

from grammarbt.errors import GrammarBTError, RunError

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.context import ForkServerProcess

Answer = TypeVar("Answer")
Call: TypeAlias = Callable[[], object]
Packed: TypeAlias = tuple[object, tuple[str, str | None] | None]

_PATIENCE = 5.0
"""Seconds that a process that has hung up gets to end."""

_GLANCE = 0.02
"""Seconds between two looks at a process's memory."""

_WORKER_MODULE = "grammarbt.run.worker"
"""Imported once by the server that worker processes are forked from, so that each starts fast."""


@frozen
class Limits:
    """What a call may take.

    Attributes:
        seconds: how long, the process's start not included; None for no limit.
        memory: bytes that its process may hold in memory; None for no limit.
    """

    seconds: float | None = None
    memory: int | None = None


class Worker:
    """A process that does one call after the other.

    Args:
        initializer: called in the process before its first call; can be pickled.
        limits: what a call may take.
    """

    def __init__(self, initializer: Call, limits: Limits) -> None:
        self._initializer = initializer
        self._limits = limits
        self._process: ForkServerProcess | None = None
        self._connection: Connection
        self._closed = False

    def call(self, call: Callable[[], Answer]) -> Answer:
        """The call's answer.

        Raises:
            TimeoutError: it took too long.
            MemoryError: it needs too much memory in a fresh process too, so that it cannot be an earlier call's leak.
            BrokenExecutor: the process has ended.
        """
        if self._process is not None:
            with contextlib.suppress(MemoryError):
                return self._call(call)
        self._start()
        return self._call(call)

    def close(self) -> None:
        """End the process for good: a call that begins meanwhile gets no new one."""
        self._closed = True
        self.end()

    def end(self, patience: float = 0.0) -> int | None:
        """Kill the process, unless it ends by itself in time; its exit code, negative for a signal."""
        process, self._process = self._process, None
        if process is None:
            return None
        process.join(patience)
        if process.is_alive():
            process.kill()
            process.join()
        return process.exitcode

    def _call(self, call: Callable[[], Answer]) -> Answer:
        try:
            self._connection.send(call)
            self._wait()
            packed = self._connection.recv()
        except (EOFError, ConnectionError):
            code = self.end(_PATIENCE)
            raise BrokenExecutor(f"the simulator ended its process with exit code {code}") from None
        if self._holds_too_much():
            self.end()  # calls too short to be watched leak too
        return cast("Answer", _unpacked(packed))

    def _wait(self) -> None:
        """Until there is an answer; within the limits, or the process is ended."""
        seconds = self._limits.seconds
        end = inf if seconds is None else time.monotonic() + seconds
        while not self._connection.poll(self._patience(end)):
            if time.monotonic() >= end:
                self.end()
                raise TimeoutError(f"took longer than {seconds:g} s")
            if self._holds_too_much():
                self.end()
                raise MemoryError(f"took more than {self._megabytes} MB of memory")

    def _patience(self, end: float) -> float | None:
        glance = inf if self._limits.memory is None else _GLANCE
        patience = min(glance, max(end - time.monotonic(), 0.0))
        return None if patience == inf else patience

    def _holds_too_much(self) -> bool:
        memory, process = self._limits.memory, self._process
        return memory is not None and process is not None and resident(process.pid) > memory

    @property
    def _megabytes(self) -> str:
        return f"{(self._limits.memory or 0) / 1e6:,.0f}"

    def _start(self) -> None:
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload([_WORKER_MODULE])
        self._connection, theirs = context.Pipe()
        process = context.Process(target=_serve, args=(theirs, self._initializer), daemon=True)
        process.start()
        self._process = process
        theirs.close()
        if self._closed:
            self.end()
            raise BrokenExecutor("the worker processes were shut down")
        try:
            _unpacked(self._connection.recv())
        except (EOFError, ConnectionError):
            code = self.end(_PATIENCE)
            raise RunError(
                f"a worker process ended with exit code {code} at its start", "try the domain with 'grammarbt evaluate'"
            ) from None
        if self._holds_too_much():
            self.end()
            raise RunError(
                f"a worker process takes more than {self._megabytes} MB before it simulates", "raise executor.memory"
            )


def resident(pid: int | None) -> int:
    """Bytes that a process holds in memory; 0 for one that has ended."""
    with contextlib.suppress(OSError):
        return int(Path(f"/proc/{pid}/statm").read_bytes().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    return 0


def memory_is_known() -> bool:
    """Whether this system tells how much memory a process holds."""
    return resident(os.getpid()) > 0


def _serve(connection: Connection, initializer: Call) -> None:
    """What a worker process does: answer calls until the other end hangs up."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the run, which ends its workers
    Thread(target=_end_with_the_run, daemon=True).start()
    call = initializer
    with contextlib.suppress(EOFError, ConnectionError):
        while True:
            connection.send(_packed(call))
            call = connection.recv()


def _end_with_the_run() -> None:
    """A run that is killed cannot end its workers; one in the middle of a call does not see that it has hung up."""
    run = multiprocessing.parent_process()
    if run is not None:
        run.join()
        os._exit(1)


def _packed(call: Call) -> Packed:
    """A call's answer, or its error as message and hint: not every exception can travel."""
    try:
        return call(), None
    except GrammarBTError as error:
        return None, (error.message, error.hint)
    except Exception as error:  # noqa: BLE001 - raised again where the answer is awaited
        return None, (f"a worker process failed with {type(error).__name__}: {error}", None)


def _unpacked(packed: Packed) -> object:
    answer, error = packed
    if error is not None:
        raise RunError(*error)
    return answer
