"""The executor `dask`: calls travel in bundles, and those that kill their worker are told from those that were near."""

from __future__ import annotations

import uuid
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future
from functools import partial
from math import ceil
from threading import RLock
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar, cast

from attrs import frozen
from distributed import KilledWorker
from distributed.scheduler import NoWorkerError

from grammarbt.errors import RunError
from grammarbt_dask.cluster import Cluster
from grammarbt_dask.worker import Call, Packed, Warmer, answers

if TYPE_CHECKING:
    import distributed

    from grammarbt_dask.parameters import DaskParameters

Arguments = ParamSpec("Arguments")
Answer = TypeVar("Answer")

_AHEAD = 2
"""Bundles per worker that are under way: one that runs and one that waits beside it."""


def make_dask(workers: int, initializer: Call, parameters: DaskParameters) -> DaskExecutor:
    """The executor `dask`."""
    return DaskExecutor(workers, initializer, parameters)


@frozen(eq=False)
class Task:
    """A call and where its answer is awaited."""

    call: Call
    future: Future[Any]


class DaskExecutor(Executor):
    """Calls on the workers of a cluster, which is started or joined at the first call.

    Scheduling a bundle takes dask some milliseconds, however many calls are in it. So each is a share of what waits:
    large while much does, small towards the end (guided self-scheduling; Polychronopoulos & Kuck, IEEE Trans. Computers
    C-36, 1987).

    A worker that dies takes its bundles along. Their calls are then tried once more, one after the other with nothing
    else under way: a call whose worker dies again raises `BrokenExecutor`.

    Args:
        workers: how many to start; with an address, how many to keep busy.
        initializer: called once in each worker; can be pickled.
        parameters: where the workers are.
    """

    def __init__(self, workers: int, initializer: Call, parameters: DaskParameters) -> None:
        self._workers = workers
        self._warmer = Warmer(f"grammarbt-{uuid.uuid4().hex}", initializer)
        self._open = partial(Cluster, workers, self._warmer, parameters)
        self._cluster: Cluster | None = None
        self._lock = RLock()
        self._waiting: deque[Task] = deque()
        self._suspects: deque[Task] = deque()
        self._under_way = 0
        self._lost: RunError | None = None

    def submit(
        self, fn: Callable[Arguments, Answer], /, *args: Arguments.args, **kwargs: Arguments.kwargs
    ) -> Future[Answer]:
        """Call on a worker.

        Raises:
            RunError: the cluster cannot be used, or its scheduler has gone.
        """
        future: Future[Answer] = Future()
        with self._lock:
            if self._lost:
                raise self._lost
            if self._cluster is None:
                self._cluster = self._open()
            self._waiting.append(Task(partial(fn, *args, **kwargs), future))
        # From dask's own thread, which runs when this one awaits an answer: by then all that can wait does.
        self._cluster.soon(self._send_more)
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Leave the cluster; calls still going on are lost."""
        del wait, cancel_futures
        with self._lock:
            self._lost = RunError("the executor has been shut down")
            cluster, self._cluster = self._cluster, None
        if cluster is not None:
            cluster.close()

    def _send_more(self) -> None:
        with self._lock:
            if self._suspects and not self._under_way:
                self._send([self._suspects[0]], alone=True)
            while self._waiting and not self._suspects and self._under_way < _AHEAD * self._workers:
                share = ceil(len(self._waiting) / self._workers)
                self._send([self._waiting.popleft() for _ in range(share)], alone=False)

    def _send(self, bundle: Sequence[Task], *, alone: bool) -> None:
        if self._cluster is not None:
            self._under_way += 1
            calls = [task.call for task in bundle]
            sent = self._cluster.client.submit(answers, self._warmer.name, calls, pure=False)
            sent.add_done_callback(partial(self._landed, bundle, alone=alone))

    def _landed(self, bundle: Sequence[Task], sent: distributed.Future[Any], *, alone: bool) -> None:
        """Hand over what has come back; called in a thread of dask's."""
        if alone:
            with self._lock:
                self._suspects.popleft()
        try:
            packed = cast("list[Packed]", sent.result())
        except KilledWorker:
            self._died(bundle, alone=alone)
        except CancelledError:
            self._lose(bundle, "the connection to the dask scheduler is lost", "when it runs again")
        except NoWorkerError:
            self._lose(
                bundle, "the workers have died, and none has come in their place", "when the machine is less busy"
            )
        except Exception as error:  # noqa: BLE001 - raised again where the answers are awaited
            _fail(bundle, RunError(f"dask failed with {type(error).__name__}: {error}"))
        else:
            _deliver(bundle, packed)
        with self._lock:
            self._under_way -= 1
        self._send_more()

    def _died(self, bundle: Sequence[Task], *, alone: bool) -> None:
        if alone:
            _fail(bundle, BrokenExecutor("the simulator ended its worker"))
        else:
            with self._lock:
                self._suspects.extend(bundle)

    def _lose(self, bundle: Sequence[Task], message: str, condition: str) -> None:
        with self._lock:
            self._lost = self._lost or RunError(message, f"{condition}, go on with 'grammarbt resume'")
            left = [*bundle, *self._suspects, *self._waiting]
            self._suspects.clear()
            self._waiting.clear()
        _fail(left, self._lost)


def _deliver(bundle: Sequence[Task], packed: Sequence[Packed]) -> None:
    for task, (answer, error) in zip(bundle, packed, strict=True):
        if error is None:
            task.future.set_result(answer)
        else:
            task.future.set_exception(RunError(*error))


def _fail(bundle: Sequence[Task], error: Exception) -> None:
    for task in bundle:
        task.future.set_exception(error)
