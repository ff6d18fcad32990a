"""Bandit rules: what is known about an arm, and how urgent another pull of it is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from bisect import insort
from collections.abc import Callable, Sequence
from math import log, sqrt
from typing import Literal, Protocol

from attrs import define, field

BanditName = Literal["ucb1", "ucb1-tuned", "ucb1-normal2", "ucb1-uniform", "threshold-ascent"]
"""A rule by which a bandit chooses among arms, by the name that users type."""


@define(eq=False)
class Arm:
    """The rewards an arm has brought.

    Attributes:
        visits: how many rewards.
        total, squares: their sum and the sum of their squares.
        kept: those of them that the rule needs one by one, rising: the highest for threshold ascent, the lowest and the
            highest for UCB1-Uniform.
    """

    visits: int = field(default=0, init=False)
    total: float = field(default=0.0, init=False)
    squares: float = field(default=0.0, init=False)
    kept: list[float] = field(factory=list, init=False)

    def add(self, reward: float) -> None:
        """Count one reward."""
        self.visits += 1
        self.total += reward
        self.squares += reward * reward

    @property
    def mean(self) -> float:
        """Mean reward of an arm that was visited."""
        return self.total / self.visits

    @property
    def variance(self) -> float:
        """Variance of the rewards of an arm that was visited."""
        return max(0.0, self.squares / self.visits - self.mean**2)


class Bandit(Protocol):
    """A rule that ranks arms."""

    def observe(self, reward: float) -> None:
        """Hear of a reward once, before it is credited to arms."""
        ...

    def credit(self, arm: Arm, reward: float) -> None:
        """Give an arm the reward observed last."""
        ...

    def index(self, arm: Arm, pulls: float, trials: int) -> float:
        """Urgency of an arm pulled `pulls` times out of `trials`; the arm has brought a reward."""
        ...

    def most_urgent(self, arms: Sequence[Arm], trials: int) -> int:
        """Place of the most urgent of some arms that were pulled as often as they brought rewards; the first of equals."""
        ...


class _ByIndex(ABC):
    @abstractmethod
    def index(self, arm: Arm, pulls: float, trials: int) -> float:
        """Urgency of an arm pulled `pulls` times out of `trials`; the arm has brought a reward."""

    def most_urgent(self, arms: Sequence[Arm], trials: int) -> int:
        """Place of the most urgent of some arms that were pulled as often as they brought rewards; the first of equals."""
        urgencies = [self.index(arm, arm.visits, trials) for arm in arms]
        return urgencies.index(max(urgencies))


class _Ranged(_ByIndex):
    """Scales a bonus to the range of the rewards seen.

    Args:
        c: exploration constant.
        span: the range of the rewards where it is known beforehand.
    """

    def __init__(self, c: float, span: float | None = None) -> None:
        self.c = c
        self.fixed = span
        self.low = float("inf")
        self.high = float("-inf")

    @property
    def span(self) -> float:
        """Highest less lowest reward."""
        return self.fixed if self.fixed is not None else max(self.high - self.low, 0.0)

    def observe(self, reward: float) -> None:
        """Widen the range."""
        self.low, self.high = min(self.low, reward), max(self.high, reward)

    def credit(self, arm: Arm, reward: float) -> None:
        """Count the reward."""
        arm.add(reward)


class Ucb1(_Ranged):
    """UCB1 (Auer, Cesa-Bianchi & Fischer 2002), with the bonus scaled to the range of the rewards seen."""

    def index(self, arm: Arm, pulls: float, trials: int) -> float:
        """Mean + c · span · √(2 ln trials / pulls)."""
        return arm.mean + self.c * self.span * sqrt(2.0 * log(max(trials, 1)) / pulls)

    def bonus(self, trials: int) -> tuple[float, float]:
        """What the index consists of besides means and pulls, for all arms at once: c · span and 2 ln trials."""
        return self.c * self.span, 2.0 * log(max(trials, 1))

    def most_urgent(self, arms: Sequence[Arm], trials: int) -> int:
        """As by the index, in one go: it is asked for at every step."""
        scale, twice_log = self.bonus(trials)
        urgencies = [arm.total / arm.visits + scale * sqrt(twice_log / arm.visits) for arm in arms]
        return urgencies.index(max(urgencies))


class Ucb1Tuned(_Ranged):
    """UCB1-Tuned (same paper): the bonus shrinks with the arm's variance."""

    def index(self, arm: Arm, pulls: float, trials: int) -> float:
        """Mean + c · span · √(ln trials / pulls · min(¼, variance + √(2 ln trials / pulls)))."""
        ratio = log(max(trials, 1)) / pulls
        variance = arm.variance / self.span**2 if self.span else 0.0
        return arm.mean + self.c * self.span * sqrt(ratio * min(0.25, variance + sqrt(2.0 * ratio)))


class Ucb1Normal2(_Ranged):
    """UCB1-Normal2 (Wissow & Asai 2024): the bonus is the arm's own deviation, which needs no known range."""

    def index(self, arm: Arm, pulls: float, trials: int) -> float:  # noqa: ARG002  the protocol's signature
        """Mean + c · deviation · √(2 ln trials)."""
        return arm.mean + self.c * sqrt(arm.variance * 2.0 * log(max(trials, 1)))


class Ucb1Uniform(_Ranged):
    """UCB1-Uniform (Asai & Wissow 2026, theorem 6): for rewards spread evenly over a range of the arm's own.

    An arm that always brings the same has no bonus; between arms of one range, the one pulled more often is preferred,
    so that a search goes deep instead of broad.
    """

    def credit(self, arm: Arm, reward: float) -> None:
        """Count the reward, and widen the arm's range."""
        arm.add(reward)
        low, high = (arm.kept[0], arm.kept[-1]) if arm.kept else (reward, reward)
        arm.kept = [min(low, reward), max(high, reward)]

    def index(self, arm: Arm, pulls: float, trials: int) -> float:
        """Middle of the arm's range + c · the range · √(6 · pulls · ln trials)."""
        low, high = arm.kept
        return (low + high) / 2.0 + self.c * (high - low) * sqrt(6.0 * pulls * log(max(trials, 1)))


class ThresholdAscent(_ByIndex):
    """Threshold ascent (Streeter & Smith 2006): an arm's value is its share among the s best rewards of all.

    Args:
        best: s.
        delta: chance that a bound fails.
    """

    def __init__(self, best: int = 100, delta: float = 0.01) -> None:
        self.best = best
        self.delta = delta
        self.top: list[float] = []

    @property
    def threshold(self) -> float:
        """The s-th best reward."""
        return self.top[0] if len(self.top) == self.best else float("-inf")

    def observe(self, reward: float) -> None:
        """Keep the s best rewards, rising."""
        insort(self.top, reward)
        del self.top[: -self.best]

    def credit(self, arm: Arm, reward: float) -> None:
        """Count the reward; the threshold only rises, so one below it never matters again."""
        arm.add(reward)
        if reward >= self.threshold:
            insort(arm.kept, reward)

    def index(self, arm: Arm, pulls: float, trials: int) -> float:
        """μ + (α + √(2nμα + α²)) / n, with n pulls, μ = rewards at or above the threshold / n, α = ln(2 trials / δ)."""
        while arm.kept and arm.kept[0] < self.threshold:
            del arm.kept[0]
        alpha = log(2.0 * max(trials, 1) / self.delta)
        high = min(float(len(arm.kept)), pulls)
        return (high + alpha + sqrt(2.0 * high * alpha + alpha * alpha)) / pulls


def make_bandit(name: BanditName, c: float, span: float | None = None) -> Bandit:
    """The rule of that name."""
    if name == "threshold-ascent":
        return ThresholdAscent()
    rules: dict[str, Callable[[float, float | None], Bandit]] = {
        "ucb1": Ucb1,
        "ucb1-tuned": Ucb1Tuned,
        "ucb1-normal2": Ucb1Normal2,
        "ucb1-uniform": Ucb1Uniform,
    }
    return rules[name](c, span)
