"""A connection to a cluster, or a cluster of worker processes on this machine."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, cast

import dask
from distributed import Client, LocalCluster

from grammarbt.errors import RunError
from grammarbt_dask.worker import Shield

if TYPE_CHECKING:
    from collections.abc import Callable

    from tornado.ioloop import IOLoop

    from grammarbt_dask.parameters import DaskParameters
    from grammarbt_dask.worker import Warmer

_FAREWELL = 5
"""Seconds that closing may take."""

_CONFIGURATION = {
    "distributed.worker.multiprocessing-method": "forkserver",  # a worker that died is replaced in a moment
    "distributed.scheduler.allowed-failures": 0,  # the executor itself tries again, one call at a time
}


class Cluster:
    """Workers that are ready for a run.

    Args:
        workers: how many to start, unless there is an address.
        warmer: makes each of them ready.
        parameters: where they are.

    Attributes:
        client: what to submit to.

    Raises:
        RunError: there is no such scheduler, it has no worker, or its workers lack grammarbt.
    """

    def __init__(self, workers: int, warmer: Warmer, parameters: DaskParameters) -> None:
        for logger in ("distributed", "distributed.client"):  # what matters is said in an error of one line
            logging.getLogger(logger).setLevel(logging.CRITICAL)
        self._name = parameters.address or "this machine"
        self._warmer = warmer
        self._local = None if parameters.address else _start(workers, parameters.patience)
        try:
            self.client = self._connect(parameters)
        except BaseException:
            self._end_local()
            raise

    def soon(self, call: Callable[[], None]) -> None:
        """Call in the client's own thread."""
        cast("IOLoop", self.client.loop).add_callback(call)

    def close(self) -> None:
        """Leave the cluster; end it if it was started here."""
        if self._local is None and self.client.status == "running":
            self.client.unregister_worker_plugin(self._warmer.name)
        self.client.close(_FAREWELL)
        self._end_local()

    def _connect(self, parameters: DaskParameters) -> Client:
        try:
            client = Client(self._local or parameters.address, timeout=parameters.patience, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            raise RunError(f"there is no dask scheduler at {self._name}", "check executor.address") from error
        try:
            client.wait_for_workers(1, timeout=parameters.patience)
            if self._local is not None:
                client.register_plugin(Shield())
            client.register_plugin(self._warmer)
        except TimeoutError:
            client.close()
            raise RunError(
                f"no worker has joined {self._name} within {parameters.patience:g} s", "raise executor.patience"
            ) from None
        except Exception as error:
            client.close()
            raise RunError(
                f"the workers of {self._name} cannot run grammarbt: {type(error).__name__}: {error}",
                "install the same versions of grammarbt and its plugins there",
            ) from error
        return client

    def _end_local(self) -> None:
        if self._local is not None:
            self._local.close(_FAREWELL)


def _start(workers: int, patience: float) -> LocalCluster:
    # For as long as workers may have to be replaced; if none ever is, calls fail instead of waiting for it.
    dask.config.set({**_CONFIGURATION, "distributed.scheduler.no-workers-timeout": f"{patience} s"})
    return LocalCluster(
        n_workers=workers,
        threads_per_worker=1,
        processes=True,
        dashboard_address="127.0.0.1:0",  # a free port, so that runs side by side do not compete for one
        silence_logs=logging.CRITICAL,
    )
