"""Executors: in this process, or in worker processes that may die without taking the run along."""

from __future__ import annotations

import contextlib
import multiprocessing
import signal
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from functools import partial
from queue import LifoQueue
from typing import TYPE_CHECKING, ParamSpec, TypeAlias, TypeVar, cast

from attrs import field, frozen
from attrs.validators import gt, optional

from grammarbt.errors import GrammarBTError, ParameterError, RunError

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.context import ForkServerProcess

    from grammarbt.domain import NoParameters

Arguments = ParamSpec("Arguments")
Answer = TypeVar("Answer")
Call: TypeAlias = Callable[[], object]
Packed: TypeAlias = tuple[object, tuple[str, str | None] | None]

_PATIENCE = 5.0
"""Seconds that a process that has hung up gets to end."""

_WORKER_MODULE = "grammarbt.run.worker"
"""Imported once by the server that worker processes are forked from, so that each starts fast."""


class SerialExecutor(Executor):
    """Calls at once, in this process."""

    def submit(
        self, fn: Callable[Arguments, Answer], /, *args: Arguments.args, **kwargs: Arguments.kwargs
    ) -> Future[Answer]:
        """Call; the future is done. What the call raises is raised here."""
        future: Future[Answer] = Future()
        future.set_result(fn(*args, **kwargs))
        return future


def make_serial(workers: int, initializer: Call, parameters: NoParameters) -> SerialExecutor:
    """The executor `serial`."""
    del initializer, parameters
    if workers > 1:
        raise ParameterError(f"the serial executor has one worker, not {workers}", "choose --executor processes")
    return SerialExecutor()


@frozen
class ProcessParameters:
    """Parameters of the executor `processes`."""

    timeout: float | None = field(
        default=None,
        validator=optional(gt(0)),
        metadata={"help": "seconds that simulating one proposal may take; then its worker is killed"},
    )


def make_processes(workers: int, initializer: Call, parameters: ProcessParameters) -> ProcessExecutor:
    """The executor `processes`."""
    return ProcessExecutor(workers, initializer, parameters.timeout)


class ProcessExecutor(Executor):
    """Worker processes, each led by a thread of its own, so that one can be killed and replaced while the others go on.

    A call that takes too long raises `TimeoutError`, one whose process ends `BrokenExecutor`; later calls get a new one.

    Args:
        workers: how many processes; each is started when it is first needed.
        initializer: called in each before its first call; can be pickled.
        timeout: seconds that a call may take, the initializer not included; None for no limit.
    """

    def __init__(self, workers: int, initializer: Call, timeout: float | None) -> None:
        self._timeout = timeout
        self._workers = [_Worker(initializer) for _ in range(workers)]
        self._idle: LifoQueue[_Worker] = LifoQueue()
        for worker in self._workers:
            self._idle.put(worker)
        self._threads = ThreadPoolExecutor(workers)

    def submit(
        self, fn: Callable[Arguments, Answer], /, *args: Arguments.args, **kwargs: Arguments.kwargs
    ) -> Future[Answer]:
        """Call in the next idle process."""
        return self._threads.submit(self._call, partial(fn, *args, **kwargs))

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End all processes; calls still going on are lost."""
        del cancel_futures
        self._threads.shutdown(wait=False, cancel_futures=True)
        for worker in self._workers:
            worker.end()
        self._threads.shutdown(wait=wait)

    def _call(self, call: Callable[[], Answer]) -> Answer:
        worker = self._idle.get()
        try:
            return worker.call(call, self._timeout)
        finally:
            self._idle.put(worker)


class _Worker:
    """A process that does one call after the other; a new one takes its place when it ends."""

    def __init__(self, initializer: Call) -> None:
        self._initializer = initializer
        self._process: ForkServerProcess | None = None
        self._connection: Connection

    def call(self, call: Callable[[], Answer], timeout: float | None) -> Answer:
        if self._process is None:
            self._start()
        try:
            self._connection.send(call)
            if not self._connection.poll(timeout):
                self.end()
                raise TimeoutError(f"took longer than {timeout:g} s")
            answer = cast("Answer", _unpacked(self._connection.recv()))
        except (EOFError, ConnectionError):
            code = self.end(_PATIENCE)
            raise BrokenExecutor(f"the simulator ended its process with exit code {code}") from None
        return answer

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

    def _start(self) -> None:
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload([_WORKER_MODULE])
        self._connection, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, self._initializer), daemon=True)
        self._process.start()
        theirs.close()
        try:
            _unpacked(self._connection.recv())
        except (EOFError, ConnectionError):
            code = self.end(_PATIENCE)
            raise RunError(
                f"a worker process ended with exit code {code} at its start", "try the domain with 'grammarbt evaluate'"
            ) from None


def _serve(connection: Connection, initializer: Call) -> None:
    """What a worker process does: answer calls until the other end hangs up."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the run, which ends its workers
    call = initializer
    with contextlib.suppress(EOFError, ConnectionError):
        while True:
            connection.send(_packed(call))
            call = connection.recv()


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
