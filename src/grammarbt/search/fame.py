"""A record of good trees, for the final selection."""

from __future__ import annotations

from collections.abc import Sequence

from attrs import define

from grammarbt.bt import BehaviorTree
from grammarbt.search.bandits import Arm


@define(eq=False)
class Record:
    """A tree with the mean of its returns."""

    tree: BehaviorTree
    mean: float
    episodes: int


class HallOfFame:
    """The best trees by what is sure about them: mean less one standard error, with a spread common to all trees.

    Attributes:
        records: by tree.
        observed: the returns that the spread is that of; none where returns are certain.
    """

    def __init__(self, size: int = 64) -> None:
        self.size = size
        self.records: dict[BehaviorTree, Record] = {}
        self.observed = Arm()

    def add(self, tree: BehaviorTree, returns: Sequence[float]) -> None:
        """Remember the returns of a tree; more returns replace fewer."""
        known = self.records.get(tree)
        if returns and (known is None or known.episodes <= len(returns)):
            self.records[tree] = Record(tree, sum(returns) / len(returns), len(returns))
        if len(self.records) >= 2 * self.size:
            self.records = {record.tree: record for record in self._ranked()[: self.size]}

    def best(self, n: int) -> tuple[BehaviorTree, ...]:
        """The at most n best trees, without those that are surely worse than the first."""
        ranked = self._ranked()[:n]
        floor = ranked[0].mean - self._error(ranked[0]) if ranked else 0.0
        return tuple(record.tree for record in ranked if record.mean + self._error(record) >= floor)

    def _ranked(self) -> list[Record]:
        return sorted(self.records.values(), key=lambda record: self._error(record) - record.mean)

    def _error(self, record: Record) -> float:
        return float((self.observed.variance / record.episodes) ** 0.5) if self.observed.visits else 0.0
