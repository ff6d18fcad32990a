"""Returns that need not be simulated again: bounded, so that a run of any length fits in memory."""

from __future__ import annotations

from collections import OrderedDict
from typing import TYPE_CHECKING

from attrs import Factory, define

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

CAPACITY = 2**20
"""Returns remembered at most, a tree counting as `_TREE` of them: some 50 MB when each tree has one, 110 at worst."""

_TREE = 8
"""A tree's key and table take about the memory of so many returns."""


@define(eq=False)
class Known:
    """What is known of a tree.

    Attributes:
        returns: by scenario, in the order simulated.
        total: their sum.
    """

    returns: dict[int, float] = Factory(dict)
    total: float = 0.0

    def learn(self, scenarios: Sequence[int], returns: Sequence[float]) -> None:
        """Add the returns of scenarios that were not known."""
        for scenario, value in zip(scenarios, returns, strict=True):
            self.returns[scenario] = value
            self.total += value

    @property
    def mean(self) -> float:
        """Of all returns known; minus infinity when there are none."""
        return self.total / len(self.returns) if self.returns else float("-inf")


class ReturnCache:
    """The returns of the trees used last.

    What is forgotten depends on the order in which trees were evaluated, and on nothing else: it decides which episodes
    are simulated again, and so belongs to what a journal repeats.

    Args:
        capacity: how much is remembered, in returns.
    """

    def __init__(self, capacity: int = CAPACITY) -> None:
        self._capacity = capacity
        self._known: OrderedDict[bytes, Known] = OrderedDict()
        self._size = 0

    def __len__(self) -> int:
        return len(self._known)

    def get(self, key: bytes) -> Known:
        """What is remembered under a key; nothing yet, when that is nothing."""
        return self._known.get(key) or Known()

    def keep(self, used: Mapping[bytes, Known], simulated: int) -> None:
        """Remember what was just used, the last one longest, and forget what no longer fits.

        Args:
            used: as `get` gave it, with the returns learned since, by key.
            simulated: how many returns that were.
        """
        self._size += simulated
        for key, known in used.items():
            if known.returns:
                self._size += _TREE * (key not in self._known)
                self._known[key] = known
                self._known.move_to_end(key)
        while self._size > self._capacity:
            _, forgotten = self._known.popitem(last=False)
            self._size -= len(forgotten.returns) + _TREE

    def items(self) -> Iterator[tuple[bytes, Known]]:
        """Everything remembered, the longest unused first."""
        return iter(self._known.items())
