"""A search on a small world, without a run folder around it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from attrs import define, field

from grammarbt.bt import BehaviorTree, compile_policy
from grammarbt.domain import Domain, scenario_numbers
from grammarbt.grammar import BoundGrammar, Source, bind, load_grammar
from grammarbt.search import Evaluation, Proposal, SearchContext, Searcher
from grammarbt.testing.subjects import SearcherSubject
from grammarbt.testing.verdicts import require

_MOST_FREE_BATCHES = 10_000
"""Batches that may cost nothing, since all they ask for is known, before the search is taken to be over."""


@define(eq=False)
class TrialRun:
    """Asks, evaluates and tells, as a run does.

    Attributes:
        grammar: the language.
        searcher: the one under test.
        domain: where trees are simulated.
        episodes: simulated so far.
    """

    grammar: BoundGrammar
    searcher: Searcher
    domain: Domain
    episodes: int = 0
    _known: dict[tuple[BehaviorTree, int], float] = field(factory=dict)

    @classmethod
    def of(cls, subject: SearcherSubject, grammar: str | None = None, start: BehaviorTree | None = None) -> TrialRun:
        """A run that has not begun, by the text of a grammar or else by that of the subject's world."""
        source = subject.grammar if grammar is None else Source("the test's grammar", grammar)
        vocabulary = subject.domain.vocabulary
        bound = bind(load_grammar(source), vocabulary)
        rng = np.random.default_rng(np.random.SeedSequence(0).spawn(1)[0])
        context = SearchContext(bound, vocabulary, rng, subject.budget, start=start)
        return cls(bound, subject.make(context), subject.domain)

    def go(
        self,
        budget: int,
        distort: Callable[[Sequence[Evaluation]], Sequence[Evaluation]] = lambda told: told,
        constant: float | None = None,
    ) -> Iterator[Proposal]:
        """Every proposal until the budget is spent; told what `distort` makes of the evaluations."""
        for batch in self.batches(budget, 4, distort, constant):
            yield from batch

    def batches(
        self,
        budget: int,
        width: int,
        distort: Callable[[Sequence[Evaluation]], Sequence[Evaluation]] = lambda told: told,
        constant: float | None = None,
    ) -> Iterator[Sequence[Proposal]]:
        """Every batch, yielded before it is evaluated."""
        free = 0
        while self.episodes < budget and free < _MOST_FREE_BATCHES:
            proposals = self.searcher.ask(width)
            if not proposals:
                return
            require(
                all(isinstance(proposal, Proposal) for proposal in proposals),
                f"ask gave {proposals[0]!r}",
                "ask gives a list of grammarbt.search.Proposal",
            )
            yield proposals
            before = self.episodes
            self.searcher.tell(distort([self._evaluate(proposal, constant) for proposal in proposals]))
            free = free + 1 if self.episodes == before else 0

    def _evaluate(self, proposal: Proposal, constant: float | None) -> Evaluation:
        missing = [n for n in range(proposal.start, proposal.stop) if (proposal.tree, n) not in self._known]
        ticks: tuple[int, ...] = ()
        if missing:
            policy = compile_policy(proposal.tree, self.domain.vocabulary.index)
            outcome = self.domain.simulate(policy, np.array(missing) + scenario_numbers(0, 0, 1)[0])
            ticks = tuple(int(count) for count in outcome.ticks)
            for number, value in zip(missing, outcome.returns, strict=True):
                self._known[proposal.tree, number] = float(value) if constant is None else constant
            self.episodes += len(missing)
        returns = tuple(self._known[proposal.tree, number] for number in range(proposal.start, proposal.stop))
        return Evaluation(proposal, returns, ticks)
