"""The searcher: hands out the batches of a preset's search and gathers their evaluations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from grammarbt.bt import BehaviorTree
from grammarbt.errors import SearcherError
from grammarbt.search import Evaluation, Proposal, SearchContext
from grammarbt_dagmcts.paper import PaperSearch
from grammarbt_dagmcts.parameters import DagMctsParameters
from grammarbt_dagmcts.rerooted import RerootedSearch
from grammarbt_dagmcts.rootlist import RootList
from grammarbt_dagmcts.strategy import Strategy


class DagMcts:
    """Monte Carlo search over the derivation DAG.

    The default preset needs a language of lists of sub-trees under a control node; for any other language it falls
    back to the paper's method.
    """

    def __init__(self, context: SearchContext, parameters: DagMctsParameters) -> None:
        self.strategy = choose_strategy(context, parameters)
        self._width = 1
        self._search = self.strategy.batches(lambda: self._width)
        self._pending: list[Proposal] = []
        self._asked = 0
        self._told: list[Evaluation] = []
        self._begun = False

    def ask(self, n: int) -> Sequence[Proposal]:
        """At most n proposals of the present batch; empty when nothing is left to try."""
        if self._asked:
            raise SearcherError("dagmcts was asked again before it was told", "call tell() with every evaluation first")
        self._width = max(n, 1)
        if not self._begun:
            self._advance()
        asked = self._pending[:n]
        self._asked = len(asked)
        return asked

    def tell(self, evaluations: Sequence[Evaluation]) -> None:
        """The evaluations of the last `ask`, in the same order."""
        if len(evaluations) != self._asked:
            message = f"dagmcts was told {len(evaluations)} evaluations of {self._asked} proposals"
            raise SearcherError(message, "tell the evaluations of the last ask, in the same order")
        del self._pending[: self._asked]
        self._asked = 0
        self._told.extend(evaluations)
        if self._told and not self._pending:
            self._advance()

    def _advance(self) -> None:
        told, self._told = self._told, []
        try:
            self._pending = self._search.send(told) if self._begun else next(self._search)
        except StopIteration:
            self._pending = []
        self._begun = True

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The at most n trees the search believes in, best first."""
        return self.strategy.candidates(n)

    def metrics(self) -> Mapping[str, float]:
        """Figures about the search so far."""
        return self.strategy.metrics()


def choose_strategy(context: SearchContext, parameters: DagMctsParameters) -> Strategy:
    """The preset asked for, if it suits the language."""
    lists = RootList(context.grammar)
    if parameters.preset == "default" and lists.fits(context.rng):
        return RerootedSearch(context, parameters, lists)
    return PaperSearch(context, parameters)
