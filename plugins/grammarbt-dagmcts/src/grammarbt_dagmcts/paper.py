"""The published method: Monte Carlo search over the derivation DAG, with restarts.

Scheide, Best & Hollinger, "Learning Behavior Trees for Robotic Task Planning by Monte Carlo Search over a Formal Grammar"
(2020). Where the paper is silent, the selection rule is that of the authors' later version (ICRA 2021).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from grammarbt.bt import BehaviorTree
from grammarbt.search import Batches, SearchContext, Width
from grammarbt_dagmcts.dagsearch import DagSearch
from grammarbt_dagmcts.parameters import DagMctsParameters

LONGEST_ROLL_OUT = 2_000


class PaperSearch:
    """Roll-out after roll-out, each on a fresh scenario; every new node is joined to its ancestors."""

    def __init__(self, context: SearchContext, parameters: DagMctsParameters) -> None:
        self.start = context.start
        self.restart_every = parameters.restart_every if parameters.restarts else 0
        self.search = DagSearch(context, parameters, longest=LONGEST_ROLL_OUT, link_new=True, only_unvisited=False)

    def batches(self, width: Width) -> Batches[None]:
        """One roll-out per proposal; the first is the start tree, if there is one."""
        episodes = 0
        if self.start is not None:
            yield from self.search.begin_from(self.start)
            episodes += 1
        while planned := self.search.plan(width()):
            evaluations = yield [roll_out.proposal for roll_out in planned]
            for roll_out, evaluation in zip(planned, evaluations, strict=True):
                self.search.learn(roll_out, evaluation)
            before, episodes = episodes, episodes + len(planned)
            if self.restart_every and episodes // self.restart_every > before // self.restart_every:
                self.search.restart()

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The trees with the best returns."""
        return self.search.experience.fame.best(n)

    def metrics(self) -> Mapping[str, float]:
        """Size of the DAG and of the grammar."""
        return self.search.metrics()
