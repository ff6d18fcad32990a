"""What happens in a dask worker: the domain is made once, then bundles of calls come and answers go back."""

from __future__ import annotations

import contextlib
import signal
from collections.abc import Callable, Sequence
from threading import Lock
from typing import TypeAlias, cast

from distributed import Worker, WorkerPlugin, get_worker

from grammarbt.errors import GrammarBTError

Call: TypeAlias = Callable[[], object]
Packed: TypeAlias = tuple[object, tuple[str, str | None] | None]
"""A call's answer, or its error's message and hint: not every exception can travel."""

_one_at_a_time = Lock()
"""A process has one domain, which need not be safe to use from several threads."""

_warm = ""
"""For which run this process has been made ready last; runs that share a cluster take turns."""


class Warmer(WorkerPlugin):
    """Makes workers ready for a run, also those that join or are restarted later.

    Args:
        name: tells the run from others on the same cluster.
        initializer: makes this process's domain.
    """

    def __init__(self, name: str, initializer: Call) -> None:
        self.name = name
        self._initializer = initializer

    def setup(self, worker: Worker) -> None:
        """Make the worker ready; what goes wrong is told by the first call, which tries again."""
        del worker
        with contextlib.suppress(Exception), _one_at_a_time:
            self._make_ready()

    def answers(self, calls: Sequence[Call]) -> list[Packed]:
        """What the calls give, in their order."""
        with _one_at_a_time:
            failure = _packed(self._make_ready)[1]
            return [(None, failure) if failure else _packed(call) for call in calls]

    def _make_ready(self) -> None:
        global _warm  # noqa: PLW0603 - a process has no better place for what outlives a call
        if _warm != self.name:
            _warm = ""
            self._initializer()
            _warm = self.name


class Shield(WorkerPlugin):
    """Keeps Ctrl-C in a terminal, which reaches every process started there, from workers that the run itself ends."""

    name = "grammarbt-shield"

    def setup(self, worker: Worker) -> None:
        """Ignore it in the worker's process."""
        del worker
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def answers(name: str, calls: Sequence[Call]) -> list[Packed]:
    """What the calls give in the worker that this runs on, by the `Warmer` of that name."""
    return cast("Warmer", get_worker().plugins[name]).answers(calls)


def _packed(call: Call) -> Packed:
    try:
        return call(), None
    except GrammarBTError as error:
        return None, (error.message, error.hint)
    except Exception as error:  # noqa: BLE001 - raised again where the answer is awaited
        return None, (f"a worker failed with {type(error).__name__}: {error}", None)
