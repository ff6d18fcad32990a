"""The baseline that every searcher is measured against: independent random trees."""

from __future__ import annotations

from typing import TYPE_CHECKING

from attrs import define

from grammarbt.bt import format_tree, parse
from grammarbt.search.base import Evaluation, Proposal, SearchContext

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import Any

    from grammarbt.bt import BehaviorTree
    from grammarbt.domain import NoParameters

_KEPT = 256
"""Trees remembered for the final selection; when twice as many are known, the worse half is forgotten."""


@define
class _Record:
    episodes: int
    mean: float

    def add(self, evaluation: Evaluation) -> None:
        total = self.mean * self.episodes + sum(evaluation.returns)
        self.episodes += len(evaluation.returns)
        self.mean = total / self.episodes


class RandomSearch:
    """Samples words of the grammar, choosing among legal productions by weight, and simulates each for one episode.

    All trees meet the same scenarios: a tree's first episode is scenario 0, and one that is drawn again meets the next.
    """

    def __init__(self, context: SearchContext, parameters: NoParameters) -> None:
        del parameters
        self._grammar = context.grammar
        self._origin = context.grammar.start()
        self._rng = context.rng
        self._records: dict[BehaviorTree, _Record] = {}
        self._proposed = 0
        self._start = context.start

    def ask(self, n: int) -> Sequence[Proposal]:
        """Fresh random trees; the very first is the start tree, when there is one."""
        proposals = [self._propose() for _ in range(n)]
        self._proposed += len(proposals)
        return proposals

    def tell(self, evaluations: Sequence[Evaluation]) -> None:
        """Remember how the trees did."""
        for evaluation in evaluations:
            if evaluation.status == "ok":
                self._records.setdefault(evaluation.proposal.tree, _Record(0, 0.0)).add(evaluation)
        if len(self._records) > 2 * _KEPT:
            self._records = dict(self._ranked()[:_KEPT])

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The trees with the highest means, the earlier first among equals."""
        return [tree for tree, _ in self._ranked()[:n]]

    def metrics(self) -> Mapping[str, float]:
        """How many trees were drawn."""
        return {"trees": float(self._proposed)}

    def snapshot(self) -> Mapping[str, Any]:
        """The trees remembered, and how many were drawn."""
        records = [[format_tree(tree), record.episodes, record.mean] for tree, record in self._records.items()]
        return {"records": records, "proposed": self._proposed}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Remember what another one did, whose start tree has been tried."""
        self._records = {parse(text): _Record(episodes, mean) for text, episodes, mean in state["records"]}
        self._proposed = state["proposed"]
        self._start = None

    def _propose(self) -> Proposal:
        if self._start is not None:
            tree, self._start = self._start, None
            return Proposal(tree)
        derivation, word = self._grammar.leftmost.random_walk(self._origin, self._rng)
        tree = self._grammar.tree_of(word)
        record = self._records.get(tree)
        start = record.episodes if record else 0
        return Proposal(tree, derivation, start, start + 1)

    def _ranked(self) -> list[tuple[BehaviorTree, _Record]]:
        return sorted(self._records.items(), key=lambda item: -item[1].mean)
