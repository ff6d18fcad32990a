"""The domain: a tree chooses the action of each step of an environment."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Literal

import numpy as np

from grammarbt.bt import flatten, leaves, ticker
from grammarbt.domain import Drawing, Episode, Frame, Outcome
from grammarbt.errors import DomainError, did_you_mean
from grammarbt_gymnasium.conditions import questions_about
from grammarbt_gymnasium.environment import make_environment
from grammarbt_gymnasium.features import Number
from grammarbt_gymnasium.names import NOTHING, action_names
from grammarbt_gymnasium.parameters import GymnasiumParameters
from grammarbt_gymnasium.references import references_for
from grammarbt_gymnasium.rollout import random_rollout
from grammarbt_gymnasium.scenes import scene_of
from grammarbt_gymnasium.views import view_of
from grammarbt_gymnasium.vocabulary import Answers, RecordedAnswers, make_leaves

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from grammarbt.bt import Policy
    from grammarbt.domain import Scenarios
    from grammarbt_gymnasium.conditions import Question
    from grammarbt_gymnasium.vocabulary import Meaning


class GymnasiumDomain:
    """An environment of Gymnasium; the return of an episode is the sum of its rewards.

    Each tick chooses one action, which the environment then takes: an action leaf answers RUNNING, so the tick ends with
    it. A tick that ran none takes the idle action; of several in a parallel node, the last counts.

    Args:
        parameters: which environment, and how its observations become conditions.

    Raises:
        DomainError: the environment cannot be made or read, or has no such idle action.
    """

    grammar = "gymnasium"
    depends_on: Literal["behaviour", "tree"] = "behaviour"

    def __init__(self, parameters: GymnasiumParameters | None = None) -> None:
        self.parameters = parameters or GymnasiumParameters()
        self.environment = make_environment(self.parameters)
        self._view = view_of(self.environment)
        names, first = action_names(self.environment), int(self.environment.actions.start)
        self._idle = first + names.index(idle_action(names, self.parameters.idle))
        leaves_ = make_leaves(names, first, self._questions())
        self.vocabulary, self._meaning = leaves_.vocabulary, leaves_.meanings
        self.references = references_for(self.environment.name, self.vocabulary)

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Run one episode per scenario."""
        answers = Answers(self._meanings(policy))
        # A queue of one place runs through an episode faster than a loop would, and keeps its end.
        returns = [deque(self._play(policy, answers, int(number)), maxlen=1).pop() for number in scenarios]
        return Outcome(np.array(returns, dtype=np.float64), np.array(answers.ticks))

    def episode(self, policy: Policy, scenario: int) -> Episode:
        """The episode of a scenario: a drawing where the world is known, and the observation in words."""
        answers = RecordedAnswers(self._meanings(policy))
        scene = scene_of(self.environment, self._view)
        totals = self._play(policy, answers, scenario)
        next(totals)
        marks = tuple(scene.marks(answers.values))
        drawing = Drawing(marks)
        frames = [Frame(answers.taken(), total, drawing.changes(scene.marks(answers.values))) for total in totals]
        return Episode(tuple(frames), marks, scene.box, "reward")

    def _play(self, policy: Policy, answers: Answers, scenario: int) -> Iterator[float]:
        """Run an episode; gives the return so far before the first step and after every step."""
        tick, read, step = ticker(flatten(policy.tree)), self._view.read, self.environment.env.step
        observation, _ = self.environment.env.reset(seed=seed_of(scenario))
        answers.values = read(observation)
        total = 0.0
        yield total
        for _ in range(self.environment.max_steps):
            answers.chosen = self._idle
            tick(answers)
            observation, reward, terminated, truncated, _ = step(answers.chosen)
            answers.values = read(observation)
            total += float(reward)
            yield total
            if terminated or truncated:
                return

    def _meanings(self, policy: Policy) -> list[Meaning]:
        return [self._meaning[leaf] for leaf in leaves(policy.tree)]

    def _questions(self) -> list[Question]:
        n, spacing, features = self.parameters.thresholds, self.parameters.spacing, self._view.features
        measured = any(isinstance(feature, Number) for feature in features)
        seen = random_rollout(self.environment, self._view, self.parameters.rollout if measured else 1)
        about = enumerate(features)
        return [asked for at, feature in about for asked in questions_about(feature, at, seen[:, at], n, spacing)]


def seed_of(scenario: int) -> int:
    """The seed of a scenario's episode: 31 bits, which every simulator takes."""
    return int(np.random.SeedSequence(scenario).generate_state(1)[0]) >> 1


def idle_action(names: Sequence[str], wanted: str | None) -> str:
    """The action of a tick that ran none: the one wanted, else one that does nothing, else the first.

    Raises:
        DomainError: no action has the name that is wanted.
    """
    if wanted is None:
        return next((name for name in names if name in NOTHING), names[0])
    if wanted not in names:
        raise DomainError(f"the environment has no action {wanted!r}", did_you_mean(wanted, names))
    return wanted
