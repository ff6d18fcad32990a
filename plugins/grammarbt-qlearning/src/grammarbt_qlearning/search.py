"""The searcher: values of productions, learned from the returns of the trees that they led to."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from typing import TypeAlias

from attrs import define, field

from grammarbt.bt import BehaviorTree
from grammarbt.grammar import Derivation, parse_tree
from grammarbt.search import Batches, BatchSearcher, Scorer, SearchContext, State, States, Walk, Width, pick
from grammarbt_qlearning.choices import Choices, Option
from grammarbt_qlearning.parameters import QLearningParameters, View
from grammarbt_qlearning.policy import PolicySearch

REPEATS = 1_000
"""Derivations in a row that were simulated before, after which the search is over."""

LONGEST = 400
"""Steps of a derivation after which it takes the lowest way out: values learned so far may say to go on for ever."""

Decision: TypeAlias = "tuple[Values, Option]"
"""A state's values, and the option chosen there."""

Derived: TypeAlias = "tuple[Derivation, list[Decision]]"
"""A derivation, and the decisions in it."""


class QLearning(BatchSearcher):
    """Q-learning (Watkins 1989) over productions, as Dey & Child ("QL-BT", CIG 2013) learn the parts of a tree.

    Or, with another table, over the actions of a policy, which becomes a tree.
    """

    def __init__(self, context: SearchContext, parameters: QLearningParameters) -> None:
        learner = PolicySearch if parameters.table == "policy" else ValueSearch
        super().__init__("qlearning", learner(context, parameters))


@define(eq=False)
class Values:
    """What is known in a state: per option its value, and how often it was chosen."""

    value: dict[Option, float] = field(factory=dict)
    visits: dict[Option, int] = field(factory=dict)

    @property
    def best(self) -> float:
        """The highest value."""
        return max(self.value.values(), default=0.0)


@define(eq=False)
class Pending:
    """A nonterminal that waits: its parent's production (-1 at the root), its place among the children, its depth."""

    parent: int
    place: int
    depth: int


class ValueSearch:
    """Derives trees leftmost by the best known option, or by chance, and learns from their returns."""

    def __init__(self, context: SearchContext, parameters: QLearningParameters) -> None:
        self.context = context
        self.parameters = parameters
        self.rng = context.rng
        self.states = States(context.grammar)
        self.choices = Choices(self.states)
        self.scorer = Scorer(self.states)
        self.table: dict[Hashable, Values] = {}
        self.start = None if context.start is None else parse_tree(context.grammar, context.start)
        self.repeated = 0

    def batches(self, width: Width) -> Batches[None]:
        """As many derivations at a time as the run can use; ends when nothing new comes up any more."""
        if self.start is not None:
            yield from self._simulate([self._derived(self.start)])
        while self.repeated < REPEATS:
            yield from self._simulate([self._derived() for _ in range(width())])

    @property
    def chance(self) -> float:
        """Epsilon, now."""
        return self.parameters.chance(self.scorer.returns.visits, self.context.budget)

    def _derived(self, given: Derivation | None = None) -> Derived:
        """A derivation, or the given one, and the decisions that it takes."""
        walk, pending = self.states.walk(), [Pending(-1, 0, 0)]
        decisions: list[Decision] = []
        while (state := walk.state) is not None:
            here, options = pending.pop(), self.choices.options(state)
            option = options[0]
            if len(options) > 1:
                values = self.table.setdefault(_seen(self.parameters.view, state, here, len(options)), Values())
                rest = given and given[len(walk.derivation) :]
                option = self.choices.first(state, rest) if rest else self._choice(state, values, walk)
                decisions.append((values, option))
            for production in option:
                walk.take(production)
            parts = len(self.states.parts[option[-1]])
            pending += [Pending(option[-1], place, here.depth + 1) for place in range(parts - 1, -1, -1)]
        return tuple(walk.derivation), decisions

    def _choice(self, state: State, values: Values, walk: Walk) -> Option:
        """By chance, or the best known; what was never chosen comes first."""
        if len(walk.derivation) > LONGEST:
            return self.choices.lowest(state)
        if self.rng.random() < self.chance:
            return self.choices.draw(state, self.rng)
        options = self.choices.options(state)
        known = [values.value.get(option, float("inf")) for option in options]
        highest = max(known)
        return pick([option for option, value in zip(options, known, strict=True) if value == highest], self.rng)

    def _simulate(self, derived: Sequence[Derived]) -> Batches[None]:
        """Learn from what is new; where all scenarios are alike a tree teaches once."""
        new = [(derivation, decisions) for derivation, decisions in derived if not self.scorer.is_settled(derivation)]
        self.repeated = 0 if new else self.repeated + 1
        scores = yield from self.scorer.score([derivation for derivation, _ in new])
        for (_, decisions), score in zip(new, scores, strict=True):
            self._learn(decisions, self.scorer.reward(score))

    def _learn(self, decisions: Sequence[Decision], reward: float) -> None:
        """Backwards along the derivation, towards a mixture of the return and the next state's best value."""
        target = reward
        for values, production in reversed(decisions):
            visits = values.visits[production] = values.visits.get(production, 0) + 1
            old = values.value.get(production, target)
            values.value[production] = old + max(self.parameters.rate, 1.0 / visits) * (target - old)
            target = self.parameters.trace * target + (1.0 - self.parameters.trace) * values.best

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The trees that are best for sure."""
        return self.scorer.best(n)

    def metrics(self) -> Mapping[str, float]:
        """Size of the table, and how much is left to chance."""
        return {"states": len(self.table), "derivations": len(self.scorer.scores), "chance": self.chance}


def _seen(view: View, state: State, here: Pending, options: int) -> Hashable:
    if view == "place":
        return state.symbol, here.parent, here.place, options
    if view == "progress":
        return state.symbol, here.depth, state.form.used
    return state.form
