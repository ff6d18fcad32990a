"""The searcher: values of productions, learned from the returns of the trees that they led to."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence

from attrs import define, field, frozen

from grammarbt.bt import BehaviorTree
from grammarbt.grammar import Derivation, parse_tree
from grammarbt.search import Batches, BatchSearcher, Score, Scorer, SearchContext, State, States, Walk, Width, pick
from grammarbt_qlearning.choices import Choices, Option
from grammarbt_qlearning.imitation import Imitation
from grammarbt_qlearning.parameters import QLearningParameters, View
from grammarbt_qlearning.policy import PolicySearch

REPEATS = 1_000
"""Derivations in a row that were simulated before, after which the search is over."""

LONGEST = 400
"""Steps of a derivation after which it takes the lowest way out: values learned so far may say to go on for ever."""

TRUSTED = 4
"""Episodes after which a tree that has been better than the best one so far takes its place."""


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


@frozen(eq=False)
class Decision:
    """A nonterminal, what is known of its options in the state that it is in, and the option chosen."""

    symbol: int
    values: Values
    option: Option


@frozen(eq=False)
class Derived:
    """A derivation, and the decisions in it."""

    derivation: Derivation
    decisions: list[Decision]


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
        self.best: tuple[Score, Derived] | None = None

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
        imitation = None if given else self._imitation()
        while (state := walk.state) is not None:
            here, options = pending.pop(), self.choices.options(state)
            option = options[0]
            if len(options) > 1:
                values = self.table.setdefault(_seen(self.parameters.view, state, here, len(options)), Values())
                rest = given and given[len(walk.derivation) :]
                option = self.choices.first(state, rest) if rest else self._choice(state, values, walk, imitation)
                decisions.append(Decision(state.symbol, values, option))
            for production in option:
                walk.take(production)
            parts = len(self.states.parts[option[-1]])
            pending += [Pending(option[-1], place, here.depth + 1) for place in range(parts - 1, -1, -1)]
        return Derived(tuple(walk.derivation), decisions)

    def _imitation(self) -> Imitation | None:
        """Of the best tree, now and then."""
        if self.best is None or self.rng.random() >= self.parameters.imitation:
            return None
        chosen = [(one.symbol, one.option) for one in self.best[1].decisions]
        return Imitation(chosen, self.choices, self.rng)

    def _choice(self, state: State, values: Values, walk: Walk, imitation: Imitation | None) -> Option:
        """What is imitated, if anything; otherwise by chance, or the best known."""
        if len(walk.derivation) > LONGEST:
            return self.choices.lowest(state)
        option = imitation.option(state) if imitation else None
        if option is not None:
            return option
        if self.rng.random() < self.chance:
            return self.choices.draw(state, self.rng)
        return self._greedy(state, values)

    def _greedy(self, state: State, values: Values) -> Option:
        """The best known; what was never chosen comes first."""
        options = self.choices.options(state)
        known = [values.value.get(option, float("inf")) for option in options]
        highest = max(known)
        return pick([option for option, value in zip(options, known, strict=True) if value == highest], self.rng)

    def _simulate(self, derived: Sequence[Derived]) -> Batches[None]:
        """Learn from what is new; where all scenarios are alike a tree teaches once."""
        due = [one for one in derived if not self.scorer.is_settled(one.derivation)]
        self.repeated = 0 if due else self.repeated + 1
        while due:
            scores = yield from self.scorer.score([one.derivation for one in due])
            for one, score in zip(due, scores, strict=True):
                self._learn(one.decisions, self.scorer.reward(score))
            due = [one for one, score in zip(due, scores, strict=True) if not self._is_judged(one, score)]

    def _is_judged(self, derived: Derived, score: Score) -> bool:
        """Whether a tree is no better than the best one, or took its place: not on a single return, which may be luck."""
        worse = self.best is not None and score.mean <= self.best[0].mean
        if worse or score.failed or not self.parameters.imitation:
            return True
        trusted = score.episodes >= TRUSTED or self.scorer.is_settled(score.derivation)
        if trusted:
            self.best = score, derived
        return trusted

    def _learn(self, decisions: Sequence[Decision], reward: float) -> None:
        """Backwards along the derivation, towards a mixture of the return and the next state's best value."""
        target = reward
        for one in reversed(decisions):
            values, option = one.values, one.option
            visits = values.visits[option] = values.visits.get(option, 0) + 1
            old = values.value.get(option, target)
            values.value[option] = old + max(self.parameters.rate, 1.0 / visits) * (target - old)
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
