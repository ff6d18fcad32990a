"""Every tree of the language, smallest first, one per behaviour; says when the language is finished."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

from grammarbt.bt import BehaviorTree
from grammarbt.domain import NoParameters
from grammarbt.grammar import Derivation, parse_tree
from grammarbt.search.base import SearchContext
from grammarbt.search.batches import Batches, BatchSearcher, Width
from grammarbt.search.behaviours import behaviour_of
from grammarbt.search.scoring import Scorer
from grammarbt.search.smallest import smallest_first
from grammarbt.search.states import States


class ExhaustiveSearch(BatchSearcher):
    """Simulates one tree per behaviour, by the number of nodes, until none is left.

    In domains whose returns depend on the tree itself, every tree counts as a behaviour of its own.
    """

    def __init__(self, context: SearchContext, parameters: NoParameters) -> None:
        del parameters
        super().__init__("exhaustive", _Enumeration(context))


class _Enumeration:
    def __init__(self, context: SearchContext) -> None:
        self._context = context
        self._states = States(context.grammar)
        self._scorer = Scorer(self._states)
        self._derivations = self._behaviours()
        self._seen = 0
        self._known: set[object] = set()
        self._finished = False

    def _behaviours(self) -> Iterator[Derivation]:
        """The first derivation of each behaviour; that of the start tree comes before all others."""
        behaviour = behaviour_of(self._context)
        if self._context.start is not None:
            self._known.add(behaviour(self._context.start))
            yield parse_tree(self._context.grammar, self._context.start)
        for derivation in smallest_first(self._states):
            self._seen += 1
            key = behaviour(self._states.tree(derivation))
            if key not in self._known:
                self._known.add(key)
                yield derivation

    def batches(self, width: Width) -> Batches[None]:
        """As many new behaviours at a time as the run can use."""
        while derivations := list(islice(self._derivations, width())):
            yield from self._scorer.score(derivations)
        self._finished = True

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The trees with the highest returns."""
        return self._scorer.best(n)

    def metrics(self) -> Mapping[str, float]:
        """How many trees were looked at, how many behaviours they have, and whether that is the whole language."""
        return {"trees": self._seen, "behaviours": len(self._known), "finished": float(self._finished)}
