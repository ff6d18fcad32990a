"""Values of actions in truth assignments: a policy is learned, and written down as a tree."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import accumulate

import numpy as np
from attrs import frozen

from grammarbt.bt import Action, BehaviorTree, Condition, Leaf, Status, flatten, leaves, ticker
from grammarbt.errors import SearcherError
from grammarbt.grammar import Derivation, NotInLanguageError, parse_tree
from grammarbt.search import Batches, Score, Scorer, SearchContext, States, Width
from grammarbt_qlearning.decisionlist import DecisionLists, Flags, Numbers, Rule
from grammarbt_qlearning.parameters import QLearningParameters

MOST_CONDITIONS = 8
"""Conditions of a table at most: it has a row for each of their truth assignments."""

EXPLORED = 2
"""States, on average and besides the first, in which a policy is not greedy while epsilon is 1; more cannot be told apart."""

TRIES = 12
"""Policies drawn in search of one that the grammar has room for; each explores in half as many states."""

REPEATS = 100
"""Batches in a row of which all policies were simulated before, after which the search is over."""


@frozen(eq=False)
class Drawn:
    """A policy as a tree of the language.

    Attributes:
        derivation: of the tree.
        rules: of the policy.
        explored: (states,) where it is not the greedy one.
    """

    derivation: Derivation
    rules: Sequence[Rule]
    explored: Flags


class PolicySearch:
    """Learns what each action is worth in each truth assignment of the conditions, and writes down the greedy policy.

    The way from policy to tree is Banerjee's ("Autonomous Acquisition of Behavior Trees for Robot Control", IROS 2018):
    conditions and an action in sequence, the sequences in a fallback, made compact. What is learned from differs: he has
    the steps of a simulator, here are whole episodes. So this is Monte Carlo control (Sutton & Barto, *Reinforcement
    Learning*, 2018) of advantages (Baird 1993): how much more a policy that does otherwise in a few states returns, in the
    same scenario, than the greedy one.
    """

    def __init__(self, context: SearchContext, parameters: QLearningParameters) -> None:
        self.context = context
        self.parameters = parameters
        self.rng = context.rng
        self.states = States(context.grammar)
        self.scorer = Scorer(self.states)
        known = context.vocabulary.leaves
        conditions = [leaf for leaf in known if isinstance(leaf, Condition)]
        self.lists = DecisionLists(_fewer(conditions), [leaf for leaf in known if isinstance(leaf, Action)])
        shape = len(self.lists.truth), len(self.lists.actions)
        self.value, self.visits = np.zeros(shape), np.zeros(shape)
        self.idle: Flags = np.zeros(shape[0], dtype=np.bool_)
        self.policy: Numbers = np.zeros(shape[0], dtype=np.int64)
        self.repeated = 0
        self.greedy = self._simplest()

    def _simplest(self) -> Drawn:
        """The policy of one action, which must be in the language."""
        rules = self.lists.rules(self.policy, self.idle)
        try:
            return Drawn(parse_tree(self.context.grammar, self.lists.tree(rules)), rules, self.idle)
        except NotInLanguageError as error:
            raise SearcherError(
                f"the grammar derives no policies, such as this one: {error.message}",
                "table=policy needs fallbacks of sequences of conditions and an action; table=productions needs none",
            ) from None

    def batches(self, width: Width) -> Batches[None]:
        """As many policies at a time as the run can use; ends when nothing new comes up any more."""
        if self.context.start is not None:
            self._follow(self._policy_of(self.context.start))
            yield from self.scorer.score([parse_tree(self.context.grammar, self.context.start)])
        while self.repeated < REPEATS:
            drawn = [self._drawn() for _ in range(max(1, width() - 1))]
            yield from self._simulate([self.greedy, *(one for one in drawn if one is not None)])

    def _policy_of(self, tree: BehaviorTree) -> Numbers:
        """The action that a tree ticks first in each state; the first of all where it ticks none."""
        tick, asked, found = ticker(flatten(tree)), leaves(tree), []
        for truth in self.lists.truth.tolist():
            state = _Forced(dict(zip(self.lists.conditions, map(bool, truth), strict=True)), asked)
            tick(state)
            found.append(0 if state.first is None else self.lists.actions.index(state.first))
        return np.array(found)

    @property
    def chance(self) -> float:
        """Epsilon, now."""
        return self.parameters.chance(self.scorer.returns.visits, self.context.budget)

    def _drawn(self) -> Drawn | None:
        """The greedy policy but for some states; None if the grammar has no room for any of those tried."""
        states, actions = self.value.shape
        for attempt in range(TRIES):
            explored = self.rng.random(states) < self.chance * EXPLORED / states / 2**attempt
            explored[self.rng.integers(states)] = True
            policy = np.where(explored, self.rng.integers(actions, size=states), self.policy)
            drawn = self._written(policy, explored)
            if drawn is not None:
                return drawn
        return None

    def _written(self, policy: Numbers, explored: Flags) -> Drawn | None:
        """A policy as a tree; None if that is not in the language."""
        rules = self.lists.rules(policy, self.idle & ~explored)
        try:
            return Drawn(parse_tree(self.context.grammar, self.lists.tree(rules)), rules, explored)
        except NotInLanguageError:
            return None

    def _simulate(self, drawn: Sequence[Drawn]) -> Batches[None]:
        """Learn from policies beside the greedy one, which comes first; what is known teaches again, at no cost."""
        greedy, *others = {one.derivation: one for one in drawn}.values()
        known = all(self.scorer.is_settled(one.derivation) for one in others)
        self.repeated = self.repeated + 1 if known else 0
        usual, *scores = yield from self.scorer.score([one.derivation for one in (greedy, *others)])
        for one, score in zip(others, scores, strict=True):
            self._learn(one, score, self.scorer.reward(score) - self.scorer.reward(usual))
        self._improve()

    def _learn(self, drawn: Drawn, score: Score, gain: float) -> None:
        """Credit the actions explored, weighted by how often they acted; a rule that never did leaves its states idle."""
        for rule, ticks in zip(drawn.rules, _acted(drawn.rules, score), strict=True):
            self.idle[rule.states] = not ticks
            cells = rule.states & drawn.explored, rule.action
            if ticks and cells[0].any():
                self.visits[cells] += ticks
                rate = np.maximum(self.parameters.rate, ticks / self.visits[cells])
                self.value[cells] += rate * (gain - self.value[cells])

    def _improve(self) -> None:
        """Be greedy where the grammar has room for it; advantages are then those over the new actions."""
        states = np.arange(len(self.policy))
        self.value[states, self.policy] = 0.0
        better = np.where(self.value.max(axis=1) > 0.0, self.value.argmax(axis=1), self.policy)
        if self._follow(better):
            self.value -= self.value[states, better][:, None]

    def _follow(self, policy: Numbers) -> bool:
        """Take a policy for the greedy one, if the grammar has room for it."""
        written = self._written(policy, self.idle & False)
        if written is not None:
            self.policy, self.greedy = policy, written
        return written is not None

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The trees that are best for sure."""
        return self.scorer.best(n)

    def metrics(self) -> Mapping[str, float]:
        """Size of the table, the states that never came up, and how much is left to chance."""
        return {
            "states": len(self.value),
            "idle": int(self.idle.sum()),
            "derivations": len(self.scorer.scores),
            "chance": self.chance,
        }


def _fewer(conditions: Sequence[Condition]) -> Sequence[Condition]:
    if not 1 <= len(conditions) <= MOST_CONDITIONS:
        raise SearcherError(
            f"a policy over {len(conditions)} conditions has too many states, or none",
            f"table=policy is for domains with 1 to {MOST_CONDITIONS} conditions; table=productions for all",
        )
    return conditions


def _acted(rules: Sequence[Rule], score: Score) -> list[float]:
    """How often each rule's action was ticked in an episode; once if nothing was recorded."""
    ends = accumulate(1 + sum(wanted >= 0 for wanted in rule.test) for rule in rules)
    return [score.ticks[end - 1] / score.episodes if score.ticks else 1.0 for end in ends]


class _Forced:
    """Answers for the leaves of a tree in one state; every action runs on, so that the first one ends the tick."""

    def __init__(self, answers: Mapping[Condition, bool], asked: Sequence[Leaf]) -> None:
        self.answers, self.asked = answers, asked
        self.first: Action | None = None

    def __getitem__(self, occurrence: int) -> int:
        leaf = self.asked[occurrence]
        if isinstance(leaf, Condition):
            return self.answers[leaf]
        self.first = self.first or leaf
        return Status.RUNNING
