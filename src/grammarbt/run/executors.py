"""Executors: in this process, or in worker processes that may die without taking the run along."""

from __future__ import annotations

from concurrent.futures import Executor, Future, ThreadPoolExecutor
from functools import partial
from queue import LifoQueue
from typing import TYPE_CHECKING, ParamSpec, TypeVar

from attrs import field, frozen
from attrs.validators import gt, optional

from grammarbt.errors import ParameterError
from grammarbt.run.process import Call, Limits, Worker, memory_is_known

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.domain import NoParameters

Arguments = ParamSpec("Arguments")
Answer = TypeVar("Answer")


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
    memory: int | None = field(
        default=None,
        validator=optional(gt(0)),
        metadata={"help": "MB (of 10^6 bytes) that a worker may hold; then it is killed and replaced; on Linux"},
    )


def make_processes(workers: int, initializer: Call, parameters: ProcessParameters) -> ProcessExecutor:
    """The executor `processes`."""
    if parameters.memory is not None and not memory_is_known():
        raise ParameterError("executor.memory needs Linux's /proc", "leave it out on this machine")
    limits = Limits(parameters.timeout, parameters.memory and parameters.memory * 1_000_000)
    return ProcessExecutor(workers, initializer, limits)


class ProcessExecutor(Executor):
    """Worker processes, each led by a thread of its own, so that one can be killed and replaced while the others go on.

    A call that takes too long raises `TimeoutError`, one that needs too much memory `MemoryError`, and one whose process
    ends `BrokenExecutor`; later calls get a new process.

    Args:
        workers: how many processes; each is started when it is first needed.
        initializer: called in each before its first call; can be pickled.
        limits: what a call may take.
    """

    def __init__(self, workers: int, initializer: Call, limits: Limits) -> None:
        self._workers = [Worker(initializer, limits) for _ in range(workers)]
        self._idle: LifoQueue[Worker] = LifoQueue()
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
            worker.close()
        self._threads.shutdown(wait=wait)

    def _call(self, call: Callable[[], Answer]) -> Answer:
        worker = self._idle.get()
        try:
            return worker.call(call)
        finally:
            self._idle.put(worker)
