"""A search written as one generator of batches, instead of a state machine that is asked and told."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping, Sequence
from typing import Protocol, TypeAlias, TypeVar

from grammarbt.bt import BehaviorTree
from grammarbt.errors import SearcherError
from grammarbt.search.base import Evaluation, Proposal

Result = TypeVar("Result")
Batches: TypeAlias = Generator[list[Proposal], list[Evaluation], Result]
"""Yields proposals and is sent their evaluations in the same order; a whole search ends when nothing is left to try."""

Width: TypeAlias = Callable[[], int]
"""How many independent proposals the run can use now."""


class Strategy(Protocol):
    """A search method: `batches` is its whole course."""

    def batches(self, width: Width) -> Batches[None]:
        """The search itself."""
        ...

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """At most n trees, best first."""
        ...

    def metrics(self) -> Mapping[str, float]:
        """Figures about the search so far."""
        ...


class Scenarios:
    """Hands out ranges of scenarios that were never used before."""

    def __init__(self) -> None:
        self.used = 0

    def fresh(self, n: int) -> int:
        """The first of n new ones."""
        start = self.used
        self.used += n
        return start


class BatchSearcher:
    """The searcher of a strategy: hands out its batches piece by piece, and gathers their evaluations.

    Args:
        name: for messages.
        strategy: the method.
    """

    def __init__(self, name: str, strategy: Strategy) -> None:
        self.name = name
        self.strategy = strategy
        self._width = 1
        self._batches = strategy.batches(lambda: self._width)
        self._pending: list[Proposal] = []
        self._asked = 0
        self._told: list[Evaluation] = []
        self._begun = False

    def ask(self, n: int) -> Sequence[Proposal]:
        """At most n proposals of the present batch; empty when nothing is left to try."""
        if self._asked:
            raise SearcherError(
                f"{self.name} was asked again before it was told", "call tell() with every evaluation first"
            )
        self._width = max(n, 1)
        if not self._begun:
            self._advance()
        asked = self._pending[:n]
        self._asked = len(asked)
        return asked

    def tell(self, evaluations: Sequence[Evaluation]) -> None:
        """The evaluations of the last `ask`, in the same order."""
        if len(evaluations) != self._asked:
            message = f"{self.name} was told {len(evaluations)} evaluations of {self._asked} proposals"
            raise SearcherError(message, "tell the evaluations of the last ask, in the same order")
        del self._pending[: self._asked]
        self._asked = 0
        self._told.extend(evaluations)
        if self._told and not self._pending:
            self._advance()

    def _advance(self) -> None:
        told, self._told = self._told, []
        try:
            self._pending = self._batches.send(told) if self._begun else next(self._batches)
        except StopIteration:
            self._pending = []
        self._begun = True

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The at most n trees the search believes in, best first."""
        return self.strategy.candidates(n)

    def metrics(self) -> Mapping[str, float]:
        """Figures about the search so far."""
        return self.strategy.metrics()
