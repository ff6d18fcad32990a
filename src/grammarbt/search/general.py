"""Searching any grammar: anneal where one episode tells a tree's worth, race where worlds differ."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from attrs import frozen

from grammarbt.bt import BehaviorTree
from grammarbt.grammar import Derivation, parse_tree
from grammarbt.search.annealing import AnnealedSearch
from grammarbt.search.base import Proposal, SearchContext
from grammarbt.search.batches import Batches, Strategy, Width
from grammarbt.search.climb import Climb
from grammarbt.search.climbparameters import ClimbParameters
from grammarbt.search.edits import Edits
from grammarbt.search.space import EditSpace

PROBED = 12
"""Random trees that are simulated in a few scenarios each."""
SCENARIOS = 3
QUIET = 0.1
"""How much scenarios may matter, as a share of how much trees differ: of the spread of random ones, or the gain so far."""


def search_any_grammar(context: SearchContext, parameters: ClimbParameters) -> GeneralSearch:
    """The search of a language whose trees need not be lists."""
    edits = Edits(context.grammar)
    start = None if context.start is None else parse_tree(context.grammar, context.start)
    annealed = AnnealedSearch(context, edits, parameters.round_episodes, start)
    return GeneralSearch(annealed, Climb(context, parameters, EditSpace(edits)))


@frozen(eq=False)
class GeneralSearch:
    """Probes how much scenarios matter, and hands over to one of two strategies.

    Args:
        annealed: for domains in which they hardly do.
        raced: for the others, and from the moment that a good tree turns out to depend on the scenario.
    """

    annealed: AnnealedSearch
    raced: Strategy

    def batches(self, width: Width) -> Batches[None]:
        """The search."""
        returns = yield from self._probe([self.annealed.edits.sample(self.annealed.rng) for _ in range(PROBED)])
        means = [_mean(own) for own in returns]
        differ = float(np.std(means)) if means else 0.0
        best = max(returns, key=_mean, default=(0.0,))
        while differ > 0.0 and max(best) - min(best) <= QUIET * differ:
            place = yield from self.annealed.round(width)
            returns = yield from self._probe([place.derivation])
            best = max(returns, key=_mean, default=best)
            differ = max(differ, _mean(best) - float(np.mean(means)))
        yield from self.raced.batches(width)

    def _probe(self, derivations: Sequence[Derivation]) -> Batches[list[tuple[float, ...]]]:
        """Each tree's returns in a few scenarios; of a tree that fails, nothing."""
        trees = [self.annealed.edits.states.tree(derivation) for derivation in derivations]
        told = yield [
            Proposal(tree, derivation, 0, SCENARIOS) for tree, derivation in zip(trees, derivations, strict=True)
        ]
        return [evaluation.returns for evaluation in told if evaluation.returns]

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """Those of the strategy at work."""
        return (self.raced if self.raced.candidates(1) else self.annealed).candidates(n)

    def metrics(self) -> Mapping[str, float]:
        """Those of the strategy at work."""
        return (self.raced if self.raced.candidates(1) else self.annealed).metrics()


def _mean(returns: Sequence[float]) -> float:
    return sum(returns) / len(returns)
