"""Climbing from an incumbent tree: its neighbours race it, and a winner becomes the next root.

The value of a neighbour is how much it gains over the root, scenario by scenario.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from attrs import define

from grammarbt.bt import BehaviorTree, format_tree
from grammarbt.errors import SearcherError
from grammarbt.search.base import SearchContext
from grammarbt.search.batches import Batches, Scenarios, Width
from grammarbt.search.climbparameters import ClimbParameters
from grammarbt.search.fame import HallOfFame
from grammarbt.search.race import Runner, closes, differences, judge, next_stage
from grammarbt.search.rootlist import ListedTree
from grammarbt.search.space import Around, Neighbour, Space

ELITES = 2
ELITE_EVERY = 3
"""Every how many restarts the root is the best elite instead of a random tree."""
LATE = 2
"""From how many times the episodes without progress before the end every restart is from the best elite."""


@define(eq=False)
class Entrant:
    """A neighbour in its race against the root."""

    neighbour: Neighbour
    runner: Runner


class Climb:
    """Roots, races and restarts; begins from the context's start tree, if there is one.

    Args:
        context: what to search.
        parameters: when to do what.
        space: the trees and their neighbours.
    """

    def __init__(self, context: SearchContext, parameters: ClimbParameters, space: Space) -> None:
        self.parameters = parameters
        self.rng = context.rng
        self.budget = context.budget
        self.space = space
        self.scenarios = Scenarios()
        self.duel_start = self.scenarios.fresh(parameters.duel_episodes)
        self.fame = HallOfFame()
        self.elites: list[Runner] = []
        self.root: Runner | None = None
        self.start = None if context.start is None else self._recognised(context.start)
        self.low, self.high = float("inf"), float("-inf")
        self.episodes = self.accepted = self.restarts = self.races = 0

    def batches(self, width: Width) -> Batches[None]:
        """Climb from one root after another; never ends."""
        if self.start is not None:
            root = self._as_root(Runner(self.start, 0))
        else:
            root = yield from self._random_root(self.parameters.first_trees, width)
        while True:
            root = yield from self._climb(root, width)
            yield from self._duel(root)
            self.space.remember([elite.listed for elite in self.elites])
            self.restarts += 1
            if self.elites and (self.restarts % ELITE_EVERY == 0 or self._late()):
                root = self._as_root(self.elites[0])
            else:
                root = yield from self._random_root(self.parameters.restart_trees, width)

    def _late(self) -> bool:
        """Whether too little of the budget is left to climb from a random tree."""
        return self.budget - self.episodes < LATE * self.parameters.restart_after

    def _recognised(self, tree: BehaviorTree) -> ListedTree:
        listed = self.space.recognised(tree)
        if listed is None:
            message = f"the search cannot begin from {format_tree(tree)}, which is not in the language"
            raise SearcherError(message, "give a tree that the grammar derives, or none")
        return listed

    def _random_root(self, n: int, width: Width) -> Batches[Runner]:
        """The best of n random trees on one common scenario."""
        scenario = self.scenarios.fresh(1)
        tried: list[Runner] = []
        while len(tried) < n:
            runners = [Runner(self.space.sample(self.rng), scenario) for _ in range(min(n - len(tried), width()))]
            yield from self._simulate([(runner, 1) for runner in runners])
            for runner in runners:
                self.fame.add(runner.listed.tree, runner.returns)
            tried += runners
        return self._as_root(max(tried, key=lambda runner: runner.mean))

    def _as_root(self, runner: Runner) -> Runner:
        """A root has scenarios of its own; what is known of its ticks stays known."""
        self.fame.add(runner.listed.tree, runner.returns)
        start = self.scenarios.fresh(self.parameters.race_episodes)
        return Runner(runner.listed, start, ticks=runner.ticks, watched=runner.watched)

    def _climb(self, root: Runner, width: Width) -> Batches[Runner]:
        """Follow winners until none was found for long; gives the last root."""
        since = self.episodes
        neighbourhood = self._around(root)
        while self.episodes - since < self.parameters.restart_after and not root.failed:
            shorter = self.space.trimmed(root)
            if shorter is not root:
                root, neighbourhood = shorter, self._around(shorter)
            neighbourhood.look(root)
            self.root = root
            entrants = self._entrants(neighbourhood, root, width())
            if not entrants:
                break
            winner = yield from self._race(root, entrants, neighbourhood)
            if winner is not None:
                self.accepted += 1
                self.fame.add(root.listed.tree, root.returns)
                root, since = self._as_root(winner), self.episodes
                neighbourhood = self._around(root)
        return root

    def _around(self, root: Runner) -> Around:
        return self.space.around(root.listed, self.rng)

    def _entrants(self, neighbourhood: Around, root: Runner, n: int) -> list[Entrant]:
        found = []
        for _ in range(n):
            neighbour = neighbourhood.draw()
            if neighbour is None:
                break
            neighbourhood.memory.closed.add(neighbour.key)  # so that nobody runs twice at a time
            runner = neighbourhood.memory.waiting.get(neighbour.key) or Runner(neighbour.listed, root.start)
            found.append(Entrant(neighbour, runner))
        self.races += len(found)
        return found

    def _race(self, root: Runner, entrants: list[Entrant], neighbourhood: Around) -> Batches[Runner | None]:
        """Run until an entrant wins, or all have lost."""
        last = self.parameters.race_episodes
        while entrants:
            stops = [next_stage(len(entrant.runner.returns), last) for entrant in entrants]
            runners = [entrant.runner for entrant in entrants]
            yield from self._simulate([(root, max(stops)), *zip(runners, stops, strict=True)])
            if root.failed:
                return None
            winners: list[Runner] = []
            running = []
            for entrant in entrants:
                verdict = self._judge(entrant, root)
                if verdict == "go on":
                    running.append(entrant)
                    continue
                self._credit(entrant, root, neighbourhood)
                if verdict == "accept":
                    winners.append(entrant.runner)
                else:
                    self._dismiss(entrant, root, neighbourhood)
            if winners:
                return max(winners, key=lambda runner: runner.mean)
            entrants = running
        return None

    def _judge(self, entrant: Entrant, root: Runner) -> str:
        if entrant.runner.failed:
            return "reject"
        return judge(differences(entrant.runner, root), self.parameters.race_episodes)

    def _credit(self, entrant: Entrant, root: Runner, neighbourhood: Around) -> None:
        """The mean gain over the root, in halves of the range of returns."""
        gains = differences(entrant.runner, root)
        scale = (self.high - self.low) / 2.0 or 1.0
        reward = max(-1.0, min(1.0, sum(gains) / len(gains) / scale)) if gains else -1.0
        neighbourhood.credit(entrant.neighbour, reward)

    def _dismiss(self, entrant: Entrant, root: Runner, neighbourhood: Around) -> None:
        """Close a neighbour that lost, unless it is worth one more chance."""
        gains = differences(entrant.runner, root)
        second = neighbourhood.memory.waiting.pop(entrant.neighbour.key, None) is not None
        if not (second or entrant.runner.failed or closes(gains, self.parameters.race_episodes)):
            neighbourhood.memory.waiting[entrant.neighbour.key] = entrant.runner
            neighbourhood.memory.closed.discard(entrant.neighbour.key)

    def _duel(self, root: Runner) -> Batches[None]:
        """Compare the root with the elites on scenarios common to all duels, and keep the best."""
        self.fame.add(root.listed.tree, root.returns)
        if root.failed or any(elite.listed.tree == root.listed.tree for elite in self.elites):
            return
        challenger = Runner(root.listed, self.duel_start)
        yield from self._simulate([(challenger, self.parameters.duel_episodes)])
        self.fame.add(challenger.listed.tree, challenger.returns)
        self.elites = sorted([*self.elites, challenger], key=lambda runner: -runner.mean)[:ELITES]

    def _simulate(self, wanted: Sequence[tuple[Runner, int]]) -> Batches[None]:
        """Bring each runner's returns up to a number of scenarios."""
        due = [(runner, proposal) for runner, stop in wanted if (proposal := runner.proposal(stop)) is not None]
        if not due:
            return
        evaluations = yield [proposal for _, proposal in due]
        for (runner, _), evaluation in zip(due, evaluations, strict=True):
            runner.learn(evaluation)
            self.episodes += len(evaluation.returns)
            for value in evaluation.returns:
                self.fame.observed.add(value)
                self.low, self.high = min(self.low, value), max(self.high, value)

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """Roots and elites, the surest first; the present root is among them."""
        if self.root is not None:
            self.fame.add(self.root.listed.tree, self.root.returns)
        return self.fame.best(n)

    def metrics(self) -> Mapping[str, float]:
        """Partial trees met, and how the races went."""
        return {
            "nodes": self.space.nodes,
            "races": self.races,
            "accepted": self.accepted,
            "restarts": self.restarts,
        }
