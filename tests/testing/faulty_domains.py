"""Domains with one fault each; every class says in `caught_by` which check must find it."""

import os
import random
import time

import numpy as np
from attrs import evolve

from grammarbt.bt import Status
from grammarbt.domain import ActionType, ConditionType, Group, Outcome, Reference, Vocabulary
from grammarbt.testing.worlds import Lamps


class NoLeaves(Lamps):
    caught_by = "language has trees"
    vocabulary = Vocabulary(())
    references = ()


class ForeignReference(Lamps):
    caught_by = "language has trees"
    references = (Reference("other", "[make tea]"),)


class OneReturnForAll(Lamps):
    caught_by = "outcome has the right shape"

    def simulate(self, policy, scenarios):
        outcome = super().simulate(policy, scenarios)
        return Outcome(outcome.returns[:1], outcome.ticks)


class TicksPerKind(Lamps):
    caught_by = "outcome has the right shape"

    def simulate(self, policy, scenarios):
        outcome = super().simulate(policy, scenarios)
        return Outcome(outcome.returns, np.zeros(len(self.vocabulary.leaves), dtype=np.int64))


class NotANumber(Lamps):
    caught_by = "returns are finite and in range"

    def step(self):
        super().step()
        self.reward = self.reward if self.lit["red"] else float("nan")


class AboveItsRange(Lamps):
    caught_by = "returns are finite and in range"
    return_range = (0.0, 5.0)


class RemembersTheLastEpisode(Lamps):
    caught_by = "same scenario same return"
    debt = 0.0

    def step(self):
        super().step()
        if self.done:
            self.reward, self.debt = self.reward - self.debt, self.reward / 2


class OwnRandomness(Lamps):
    caught_by = "same scenario same return"

    def reset(self, rng):
        super().reset(np.random.default_rng())


class DependsOnTheProcess(Lamps):
    caught_by = "same return in another process"

    def step(self):
        super().step()
        self.reward += os.getpid() % 1000 + (hash("red") % 7)


class ParentsState(Lamps):
    """Works only where its module was told something first, as a lambda or an open handle would."""

    caught_by = "same return in another process"

    def __init__(self):
        if "PYTHONHASHSEED" in os.environ:
            raise RuntimeError("no connection to the simulator")


class EndlessElsewhere(Lamps):
    caught_by = "same return in another process"

    def step(self):
        super().step()
        while "PYTHONHASHSEED" in os.environ:
            time.sleep(1)


class CostlyQuestions(Lamps):
    caught_by = "conditions have no side effects"

    def condition(self, name, **arguments):
        self.price = {lamp: price * 0.99 for lamp, price in self.price.items()}
        return super().condition(name, **arguments)


class SharedRandomness(Lamps):
    caught_by = "global randomness is untouched"

    def reset(self, rng):
        random.shuffle([1, 2, 3])
        super().reset(rng)


class RewardUpsideDown(Lamps):
    caught_by = "reference beats idle"

    def step(self):
        super().step()
        self.reward = -self.reward


class OtherEpisode(Lamps):
    caught_by = "episode is the one scored"

    def episode(self, policy, scenario):
        return super().episode(policy, scenario + 1)


class OtherTree(Lamps):
    caught_by = "episode is the one scored"

    def episode(self, policy, scenario):
        episode = super().episode(policy, scenario)
        return evolve(episode, frames=tuple(evolve(frame, answers=frame.answers[:1]) for frame in episode.frames))


class UndeclaredAnswer(Lamps):
    caught_by = "actions answer as declared"
    vocabulary = Vocabulary(
        tuple(
            Group(
                lamp,
                (ActionType(f"light {lamp}", results=frozenset({Status.RUNNING})),),
                (ConditionType(f"{lamp} lit"),),
            )
            for lamp in ("red", "green", "blue")
        )
    )
