"""The searcher, and which preset's method it follows."""

from __future__ import annotations

from grammarbt.search import BatchSearcher, RootList, SearchContext, Strategy
from grammarbt_dagmcts.paper import PaperSearch
from grammarbt_dagmcts.parameters import DagMctsParameters
from grammarbt_dagmcts.rerooted import RerootedSearch


class DagMcts(BatchSearcher):
    """Monte Carlo search over the derivation DAG.

    The default preset needs a language of lists of sub-trees under a control node; for any other language it falls
    back to the paper's method.
    """

    def __init__(self, context: SearchContext, parameters: DagMctsParameters) -> None:
        super().__init__("dagmcts", choose_strategy(context, parameters))


def choose_strategy(context: SearchContext, parameters: DagMctsParameters) -> Strategy:
    """The preset asked for, if it suits the language."""
    lists = RootList(context.grammar)
    if parameters.preset == "default" and lists.fits(context.rng):
        return RerootedSearch(context, parameters, lists)
    return PaperSearch(context, parameters)
