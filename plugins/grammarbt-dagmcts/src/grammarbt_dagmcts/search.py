"""The searcher, and which preset's method it follows."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from grammarbt.bt import BehaviorTree
from grammarbt.errors import SearcherError
from grammarbt.grammar import BoundGrammar
from grammarbt.search import (
    BatchSearcher,
    BlockDag,
    Climb,
    ListSpace,
    RootList,
    SearchContext,
    Strategy,
    Stream,
    block_dags,
    make_bandit,
    search_any_grammar,
)
from grammarbt_dagmcts.dag import Dag
from grammarbt_dagmcts.mcdags import McdagsSearch
from grammarbt_dagmcts.paper import PaperSearch
from grammarbt_dagmcts.parameters import DagMctsParameters
from grammarbt_dagmcts.trace import write_graphml

Traced = Callable[[], tuple[BoundGrammar, Iterable[Dag | BlockDag]]]
"""The DAGs of a search, and the grammar that they are of."""


class DagMcts(BatchSearcher):
    """Monte Carlo search over the derivation DAG.

    The default preset goes from list to list where trees are lists of sub-trees under a control node; in any other
    language it goes from derivation to derivation, and there is no DAG to trace.
    """

    def __init__(self, context: SearchContext, parameters: DagMctsParameters) -> None:
        strategy, self._traced = choose_strategy(context, parameters)
        super().__init__("dagmcts", strategy)
        self._trace = None if parameters.trace is None else _checked(Path(parameters.trace), self._traced)

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The at most n trees the search believes in, best first; writes the trace, as this is asked at the end."""
        if self._trace is not None and self._traced is not None:
            grammar, dags = self._traced()
            write_graphml(self._trace, grammar, dags)
        return super().candidates(n)


def choose_strategy(context: SearchContext, parameters: DagMctsParameters) -> tuple[Strategy, Traced | None]:
    """The preset asked for, as it suits the language; and its DAGs, if it has any."""
    if parameters.preset != "default":
        published = (PaperSearch if parameters.preset == "paper" else McdagsSearch)(context, parameters)
        return published, lambda: (published.search.grammar, [published.search.dag])
    lists = RootList(context.grammar)
    if not lists.fits(context.rng):
        return search_any_grammar(context, parameters), None
    bandit = make_bandit(parameters.bandit, 0.4 if parameters.c is None else parameters.c, span=1.0)
    dags = block_dags(context, parameters.largest_block)
    streams = {block: Stream(dag) for block, dag in dags.items()}
    space = ListSpace(lists, streams, bandit, most=parameters.largest_block, trim=parameters.trim)
    return Climb(context, parameters, space), lambda: (context.grammar, dags.values())


def _checked(path: Path, traced: Traced | None) -> Path:
    if traced is None:
        raise SearcherError("the default preset has no DAG in this language to trace", "set searcher.preset=paper")
    if not path.absolute().parent.is_dir():
        raise SearcherError(f"there is no folder for {str(path)!r}", "make it, or set searcher.trace to another file")
    return path
