"""The authors' later method: rounds of DAG search, and of annealing over the sub-trees that it found.

Scheide, Best & Hollinger, "Behavior Tree Learning for Robotic Task Planning through Monte Carlo DAG Search over a Formal
Grammar" (ICRA 2021).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from grammarbt.bt import BehaviorTree
from grammarbt.search import Batches, RootList, SearchContext, Width
from grammarbt_dagmcts.dagsearch import DagSearch
from grammarbt_dagmcts.listannealing import ListAnnealing
from grammarbt_dagmcts.parameters import DagMctsParameters

LONGEST_ROLL_OUT = 40
ROUNDS = 50
LONGEST_ROUND = 1_000
LINKINGS = 5
"""Times in a round that the best nodes of all levels are joined to their ancestors."""


class McdagsSearch:
    """Rounds of searching, each in a new DAG; later on, every other round anneals.

    Where trees are no lists of sub-trees, all rounds search.
    """

    def __init__(self, context: SearchContext, parameters: DagMctsParameters) -> None:
        self.parameters = parameters
        self.start = context.start
        self.round_length = parameters.round_length or max(1, min(LONGEST_ROUND, context.budget // ROUNDS))
        self.link_every = parameters.link_every or max(1, self.round_length // LINKINGS)
        self.search = DagSearch(context, parameters, longest=LONGEST_ROLL_OUT, link_new=False, only_unvisited=True)
        self.annealing = self._annealing(context)
        self.rounds = self.annealed = self._searched = 0

    def _annealing(self, context: SearchContext) -> ListAnnealing | None:
        lists = RootList(context.grammar)
        fits = lists.fits(context.rng)  # looked at even if nothing is annealed, so that both draw the same numbers
        if not (fits and self.parameters.annealing):
            return None
        return ListAnnealing(lists, self.search.experience, self.search.scenarios, context.rng, self.parameters)

    def batches(self, width: Width) -> Batches[None]:
        """Round after round; ends when every word was proposed."""
        if self.start is not None:
            yield from self.search.begin_from(self.start)
        more = True
        while more:
            if self.annealing is not None and self._takes_turn():
                yield from self.annealing.round(self.round_length, width)
                self.annealed += 1
            else:
                if self.rounds and self.parameters.restarts:
                    self.search.restart()
                more = yield from self._search_round(width)
            self.rounds += 1

    def _takes_turn(self) -> bool:
        """Whether this round anneals."""
        return self.rounds > self.parameters.search_rounds and (self.rounds - self.parameters.search_rounds) % 2 == 1

    def _search_round(self, width: Width) -> Batches[bool]:
        """Roll-outs for one round; gives whether there is more to try."""
        left = self.round_length
        while left:
            planned = self.search.plan(min(width(), left))
            if not planned:
                return False
            left -= len(planned)
            evaluations = yield [roll_out.proposal for roll_out in planned]
            for roll_out, evaluation in zip(planned, evaluations, strict=True):
                if self.search.learn(roll_out, evaluation) > 0.0:
                    self.search.link(self.search.last(roll_out))
                self._searched += 1
                if self._searched % self.link_every == 0:
                    self._link_levels()
        return True

    def _link_levels(self) -> None:
        """Join the best node of each level to its ancestors."""
        rewards = self.search.dag.rewards
        for level in self.search.dag.levels():
            visited = [node for node in level if rewards.visits[node]]
            if visited:
                self.search.link(max(visited, key=rewards.mean))

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The trees with the best returns."""
        return self.search.experience.fame.best(n)

    def metrics(self) -> Mapping[str, float]:
        """Size of the DAG and of the grammar, and how the rounds went."""
        accepted = self.annealing.accepted if self.annealing else 0
        return {**self.search.metrics(), "rounds": self.rounds, "annealed": self.annealed, "accepted": accepted}
