"""Composing: a tree is an ordered list of sub-trees, changed one at a time, and every change has to win a race.

Nothing is learned about which sub-tree is good where: each group's behaviours come in a stream, short ones first, and
groups that the tree lacks come six times as often.
"""

from __future__ import annotations

from grammarbt.search import (
    BatchSearcher,
    Climb,
    ListSpace,
    RootList,
    SearchContext,
    Strategy,
    Stream,
    block_dags,
    search_any_grammar,
)
from grammarbt_compose.parameters import ComposeParameters


class Compose(BatchSearcher):
    """Composes trees; in a language whose trees need not be lists, it edits derivations instead."""

    def __init__(self, context: SearchContext, parameters: ComposeParameters) -> None:
        super().__init__("compose", choose_strategy(context, parameters))


def choose_strategy(context: SearchContext, parameters: ComposeParameters) -> Strategy:
    """The search that suits the language."""
    lists = RootList(context.grammar)
    if not lists.fits(context.rng):
        return search_any_grammar(context, parameters)
    streams = {block: Stream(dag) for block, dag in block_dags(context, parameters.largest_block).items()}
    return Climb(context, parameters, ListSpace(lists, streams, most=parameters.largest_block))
