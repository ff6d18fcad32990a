"""What a searcher is: it proposes trees, is told how they did, and never simulates.

The run owns the loop, so pools, caches, budgets, journals and resume stay out of every searcher.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, Protocol, TypeAlias, runtime_checkable

import numpy as np
from attrs import frozen

from grammarbt.bt import BehaviorTree
from grammarbt.bt.vocabulary import Vocabulary
from grammarbt.grammar import BoundGrammar, Derivation

EvaluationStatus: TypeAlias = Literal["ok", "failed", "timeout", "invalid"]
"""How an evaluation ended; `"invalid"` is a tree that the domain cannot use, or a return that is no finite number."""


@frozen
class Proposal:
    """A tree to simulate on the scenarios `start` to `stop` (exclusive), counted from 0 within the run.

    Scenario i is the same world for every tree, so a searcher can compare pair by pair, and race: ask for 0–3 now, for
    4–31 only if the tree looks good. What is known already is answered from the cache and costs no budget.
    """

    tree: BehaviorTree
    derivation: Derivation | None = None
    start: int = 0
    stop: int = 1


@frozen
class Evaluation:
    """How a proposal did.

    Attributes:
        proposal: what was asked.
        returns: one return per scenario asked for, in order; empty unless the status is `"ok"`.
        ticks: how often each leaf, left to right, was ticked in the episodes simulated for this proposal; empty when
            every return was known already.
        status: a failed evaluation is data too.
        error: the reason when it is not `"ok"`.
    """

    proposal: Proposal
    returns: tuple[float, ...]
    ticks: tuple[int, ...] = ()
    status: EvaluationStatus = "ok"
    error: str = ""

    @property
    def mean(self) -> float:
        """Mean return, minus infinity for a failed evaluation."""
        return sum(self.returns) / len(self.returns) if self.returns else float("-inf")


@frozen(eq=False)
class SearchContext:
    """What a searcher is given.

    Attributes:
        grammar: the language to search.
        vocabulary: the leaves, with what is declared about them.
        rng: the only source of randomness a searcher may use.
        budget: episodes that the search may spend.
        depends_on: whether trees that behave alike have the same return (`"behaviour"`) or not (`"tree"`).
        start: a tree to begin from, or None.
    """

    grammar: BoundGrammar
    vocabulary: Vocabulary
    rng: np.random.Generator
    budget: int
    depends_on: Literal["behaviour", "tree"] = "behaviour"
    start: BehaviorTree | None = None


class Searcher(Protocol):
    """A search method; constructed with a `SearchContext` and its parameters."""

    def ask(self, n: int) -> Sequence[Proposal]:
        """At most `n` proposals; none when there is nothing left to try."""
        ...

    def tell(self, evaluations: Sequence[Evaluation]) -> None:
        """The evaluations of the last `ask`, in the same order."""
        ...

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The at most `n` trees that the searcher believes in, best first, for the final selection."""
        ...

    def metrics(self) -> Mapping[str, float]:
        """Figures about the search so far, such as nodes or restarts."""
        ...


@runtime_checkable
class Snapshotting(Searcher, Protocol):
    """A searcher that can say where it stands, so that a resumed run need not replay all that came before.

    A searcher that asks and learns fast gains little: replaying simulates nothing. The state of `SearchContext.rng` is kept
    by the run; everything else that decides what is proposed next belongs into the snapshot, in the same order.
    """

    def snapshot(self) -> Mapping[str, Any]:
        """Where the search stands after `tell` and before the next `ask`, in what JSON can hold."""
        ...

    def restore(self, state: Mapping[str, Any]) -> None:
        """Bring a searcher that was just made, with the same context and parameters, to where another one stood."""
        ...
