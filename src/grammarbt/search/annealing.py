"""Simulated annealing over a language of trees, for domains in which one episode tells a tree's worth.

Kirkpatrick, Gelatt & Vecchi, "Optimization by Simulated Annealing" (Science, 1983), in rounds. Nothing is simulated twice.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from math import exp, isfinite

import numpy as np
from attrs import frozen

from grammarbt.bt import BehaviorTree
from grammarbt.grammar import Derivation
from grammarbt.search.base import Evaluation, Proposal, SearchContext
from grammarbt.search.batches import Batches, Width
from grammarbt.search.edits import Edits
from grammarbt.search.fame import HallOfFame
from grammarbt.search.reached import ReachedTrees
from grammarbt.search.site import Site

FIRST_TREES = 50
ELITES = 5
LONGEST_FIRST_ROUND = 3_000
SHARE_OF_FIRST = 1 / 16
"""Share of the budget that the first round takes at most, where no number is given: there is room for five or more."""
GROWTH = 1.1
"""How much longer each round is than the one before, which counts where there is room for many."""
AGAIN_EVERY = 2
"""Every how many rounds one begins from one of the best trees instead of a random one."""
EXPLORING = 0.8
"""Share of the budget after which all do."""
COOL = 1 / 16
"""How much cooler than the beginning of a round the search around its best tree begins, each time."""
COOL_LENGTH = 1 / 2
"""How long that takes, in lengths of the round."""
COOL_TIMES = 2
"""How many times in a row it may bring no gain."""
LOSSES = 200
"""The first losses, which temperatures are scaled to."""
SMALL_LOSS, LARGE_LOSS = 0.05, 0.9
"""Quantiles of the losses that count as small and large."""
HOT, COLD = 100.0, 0.6
"""The first and the last temperature of a round, in small losses."""
HOTTEST = 1 / 8
"""The first temperature at most, in large losses."""
COOLING = 1 / 4
"""The last temperature at most, in first ones."""
PRICE = 0.05
"""What a production more costs, in small losses: of two trees that earn the same, the walk rather goes on from the shorter."""
IDLE = 6
"""Draws per episode of a cooling after which it ends, though most were known."""


@frozen(eq=False)
class Place:
    """Where a round stands."""

    derivation: Derivation
    site: Site
    value: float


class AnnealedSearch:
    """Rounds of annealing, from random trees and from the best of earlier rounds.

    Args:
        context: what to search.
        edits: of the grammar.
        round_episodes: episodes in which the first round cools down; None for what suits the budget.
        start: the derivation that the first round begins from, if any.
    """

    def __init__(
        self, context: SearchContext, edits: Edits, round_episodes: int | None, start: Derivation | None = None
    ) -> None:
        self.rng = context.rng
        self.edits = edits
        self.round_episodes = round_episodes or max(1, min(LONGEST_FIRST_ROUND, round(SHARE_OF_FIRST * context.budget)))
        self.exploring = EXPLORING * context.budget
        self.start = start
        self.values: dict[Derivation, float] = {}
        self.reached = ReachedTrees(context.depends_on)
        self.fame = HallOfFame()
        self.elites: list[Place] = []
        self.losses: list[float] = []
        self.begun: Counter[Derivation] = Counter()
        self.searched: set[Derivation] = set()
        self.hot = self.cold = self.price = 0.0
        self.simulated = self.copies = self.rounds = self.accepted = 0

    def round(self, width: Width) -> Batches[Place]:
        """Cool down, then search around what came of it as long as that gains; gives the best place."""
        before = self.simulated
        elite = self._elite()
        first = elite or (yield from self._first(width))
        self.begun[first.derivation] += 1
        best = yield from self._anneal(first, 1.0, self.round_episodes, width)
        best = yield from self._polish(best)
        best = yield from self._search_around(best, width, [place.site for place in self.elites] if elite else [])
        best = yield from self._polish(best)
        self.rounds += 1
        if self.simulated - before >= self.round_episodes:  # in a small language, longer rounds would find nothing new
            self.round_episodes = round(GROWTH * self.round_episodes)
        if all(best.derivation != known.derivation for known in self.elites):
            self.elites = sorted([*self.elites, best], key=lambda place: -place.value)[:ELITES]
        return best

    def _elite(self) -> Place | None:
        """The best of those that the fewest rounds began from, if it is time to make the most of what was found."""
        if self.simulated < self.exploring and self.rounds % AGAIN_EVERY < AGAIN_EVERY - 1:
            return None
        return min(self.elites, key=lambda elite: (self.begun[elite.derivation], -elite.value), default=None)

    def _first(self, width: Width) -> Batches[Place]:
        """The start tree, once, or the best of some random trees."""
        if self.start is not None:
            derivation, self.start = self.start, None
            values = yield from self._values([derivation])
            return self._place(derivation, values[0])
        drawn: list[Derivation] = []
        returns: list[float] = []
        while len(drawn) < FIRST_TREES:
            some = [self.edits.sample(self.rng) for _ in range(min(width(), FIRST_TREES - len(drawn)))]
            returns += yield from self._values(some)
            drawn += some
        at = int(np.argmax(returns))
        return self._place(drawn[at], returns[at])

    def _place(self, derivation: Derivation, value: float) -> Place:
        return Place(derivation, self.edits.site(derivation), value)

    def _search_around(self, best: Place, width: Width, others: Sequence[Site]) -> Batches[Place]:
        """Cool down from the best, which may borrow from others, as long as that gains; around each best but once."""
        length = round(COOL_LENGTH * self.round_episodes)
        in_vain = 0
        while in_vain < COOL_TIMES and best.derivation not in self.searched:
            found = yield from self._anneal(best, COOL, length, width, others)
            in_vain = 0 if found.value > best.value else in_vain + 1
            best = found
        self.searched.add(best.derivation)
        return best

    def _anneal(
        self, first: Place, scale: float, length: int, width: Width, others: Sequence[Site] = ()
    ) -> Batches[Place]:
        """Cool down once, over so many episodes; gives the best place seen."""
        here = best = first
        spent = drawn = 0
        while spent < length and drawn < IDLE * length:
            found = [self.edits.neighbour(here.site, others, self.rng) for _ in range(width())]
            derivations = [derivation for derivation in found if derivation is not None]
            drawn += len(found)
            before = self.simulated
            values = yield from self._values(derivations)
            spent += self.simulated - before
            temperature = self._temperature(scale, min(1.0, spent / length))
            for derivation, value in zip(derivations, values, strict=True):
                if self._accepts(here, derivation, value, temperature):
                    here = self._place(derivation, value)
                    self.accepted += 1
                if here.value > best.value:
                    best = here
        return best

    def _polish(self, place: Place) -> Batches[Place]:
        """Drop what is useless, as long as that gains."""
        while True:
            shorter = self.edits.shrinking.shorter(place.site, self.rng)
            values = yield from self._values(shorter)
            at = int(np.argmax(values)) if values else 0
            if not values or values[at] <= place.value:
                return place
            place = self._place(shorter[at], values[at])

    def _accepts(self, here: Place, derivation: Derivation, value: float, temperature: float) -> bool:
        gain = value - here.value - self.price * (len(derivation) - len(here.derivation))
        if gain >= 0.0:
            return True
        if not isfinite(gain):  # temperatures are scaled to what trees lose that can be simulated
            return False
        if len(self.losses) < LOSSES:
            self.losses.append(-gain)
            small, large = np.quantile(self.losses, (SMALL_LOSS, LARGE_LOSS))
            self.hot = min(HOT * float(small), HOTTEST * float(large))
            self.cold = COLD * float(small)
            self.price = PRICE * float(small)
        return temperature > 0.0 and float(self.rng.random()) < exp(gain / temperature)

    def _temperature(self, scale: float, done: float) -> float:
        """Falls geometrically; 0 as long as no loss is known that it could be scaled to."""
        first = scale * self.hot
        return first * min(COOLING, self.cold / first) ** done if first else 0.0

    def _values(self, derivations: Sequence[Derivation]) -> Batches[list[float]]:
        """The return of each; what is known is not simulated again. Trees that fail are worth nothing, and copies neither."""
        fresh = self._fresh(derivations)
        if fresh:
            told = yield [Proposal(tree, derivation) for derivation, tree in fresh.items()]
            for (derivation, tree), evaluation in zip(fresh.items(), told, strict=True):
                self.values[derivation] = evaluation.mean
                self.fame.add(tree, evaluation.returns)
                self.reached.add(tree, evaluation.ticks)
                self.simulated += _was_simulated(evaluation)
        return [self.values[derivation] for derivation in derivations]

    def _fresh(self, derivations: Sequence[Derivation]) -> dict[Derivation, BehaviorTree]:
        """What was not simulated yet, with its tree, and is no copy: it would not go the ways of a tree that was."""
        fresh: dict[Derivation, BehaviorTree] = {}
        for derivation in dict.fromkeys(derivations):
            if derivation not in self.values:
                tree = self.edits.states.tree(derivation)
                if self.reached.knows(tree):
                    self.values[derivation] = float("-inf")
                    self.copies += 1
                else:
                    fresh[derivation] = tree
        return fresh

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The trees with the highest returns."""
        return self.fame.best(n)

    def metrics(self) -> Mapping[str, float]:
        """Trees simulated, copies that were not, rounds, and moves made."""
        return {"trees": self.simulated, "copies": self.copies, "restarts": self.rounds, "accepted": self.accepted}


def _was_simulated(evaluation: Evaluation) -> bool:
    """Where a tree that behaves alike was simulated before, only returns are told, and no budget is spent."""
    return bool(evaluation.ticks) or evaluation.status != "ok"
