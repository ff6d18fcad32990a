"""Many simulations, one after the other or side by side; results come in the order asked for."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future
from typing import TYPE_CHECKING, Protocol, TypeAlias

from attrs import frozen

from grammarbt.bt import BehaviorTree, format_tree
from grammarbt.domain import Domain, Scenarios
from grammarbt.run.executors import SerialExecutor
from grammarbt.run.simulate import Simulation, simulate_trees
from grammarbt.run.worker import simulate_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

Job: TypeAlias = tuple[BehaviorTree, Scenarios]

_AHEAD = 64
"""Jobs submitted per worker before the first result is awaited, so that no worker waits for a slow neighbour, and an
executor may send many at a time."""


class Simulator(Protocol):
    """Simulates jobs."""

    def simulate(self, jobs: Iterable[Job]) -> Iterator[Simulation]:
        """The results, one per job, in their order."""
        ...


@frozen(eq=False)
class SerialSimulator:
    """Simulates one job after the other, with this domain in this process."""

    domain: Domain

    def simulate(self, jobs: Iterable[Job]) -> Iterator[Simulation]:
        """The results, one per job, in their order."""
        return iter(simulate_trees(self.domain, jobs))


@frozen(eq=False)
class PoolSimulator:
    """Simulates jobs side by side, with the domains of an executor's workers; a job whose process ends is tried once more.

    Attributes:
        submit: begins a job.
        ahead: how many are begun before the first result is awaited.
    """

    submit: Callable[[BehaviorTree, Scenarios], Future[Simulation]]
    ahead: int

    def simulate(self, jobs: Iterable[Job]) -> Iterator[Simulation]:
        """The results, one per job, in their order."""
        begun: deque[tuple[Job, Future[Simulation]]] = deque()
        for job in jobs:
            begun.append((job, self.submit(*job)))
            if len(begun) >= self.ahead:
                yield self._result(*begun.popleft())
        while begun:
            yield self._result(*begun.popleft())

    def _result(self, job: Job, future: Future[Simulation]) -> Simulation:
        try:
            return _awaited(future)
        except BrokenExecutor:
            try:
                return _awaited(self.submit(*job))
            except BrokenExecutor as error:
                return Simulation(status="failed", error=str(error))


def make_simulator(domain: Domain, executor: Executor, workers: int) -> Simulator:
    """Simulations by an executor: with the domain itself in this process, with the workers' own elsewhere."""
    if isinstance(executor, SerialExecutor):
        return SerialSimulator(domain)
    return PoolSimulator(
        lambda tree, scenarios: executor.submit(simulate_text, format_tree(tree), scenarios), _AHEAD * workers
    )


def _awaited(future: Future[Simulation]) -> Simulation:
    try:
        return future.result()
    except TimeoutError as error:
        return Simulation(status="timeout", error=str(error))
    except MemoryError as error:
        return Simulation(status="failed", error=str(error))
