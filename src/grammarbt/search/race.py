"""A race against the root on common scenarios, stopped as soon as it is decided."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt
from typing import Literal

from attrs import define, field

from grammarbt.search.base import Evaluation, Proposal
from grammarbt.search.rootlist import ListedTree

Verdict = Literal["accept", "reject", "go on"]

FEWEST_TO_ACCEPT = 4
FEWEST_GAINS = 3
ERRORS_TO_ACCEPT = 1.8
ERRORS_AT_THE_END = 1.0
FEWEST_TO_CLOSE = 6


@define(eq=False)
class Runner:
    """A tree with its returns on a row of scenarios, and how often its leaves were ticked in `watched` episodes."""

    listed: ListedTree
    start: int
    returns: list[float] = field(factory=list)
    ticks: list[int] = field(factory=list)
    watched: int = 0
    failed: bool = False

    def proposal(self, stop: int) -> Proposal | None:
        """What is still to be simulated up to the `stop`-th scenario, if anything."""
        if len(self.returns) >= stop or self.failed:
            return None
        begin = self.start + len(self.returns)
        return Proposal(self.listed.tree, self.listed.derivation, begin, self.start + stop)

    def learn(self, evaluation: Evaluation) -> None:
        """Take in what was simulated."""
        self.failed = not evaluation.returns
        self.returns.extend(evaluation.returns)
        if evaluation.ticks:  # none are known for returns that came from the cache
            before = self.ticks or [0] * len(evaluation.ticks)
            self.ticks = [a + b for a, b in zip(before, evaluation.ticks, strict=True)]
            self.watched += len(evaluation.returns)

    @property
    def mean(self) -> float:
        """Mean return so far."""
        return sum(self.returns) / len(self.returns) if self.returns else float("-inf")


def next_stage(done: int, last: int) -> int:
    """Episodes after which a race is judged next: 1, 2, 4 … and the last."""
    return min(1 << done.bit_length(), last)


def differences(challenger: Runner, root: Runner) -> list[float]:
    """By how much the challenger beats the root, scenario by scenario."""
    return [a - b for a, b in zip(challenger.returns, root.returns, strict=False)]


def judge(gains: Sequence[float], last: int) -> Verdict:
    """Reject when the mean gain is not above 0; accept when it is so by enough standard errors."""
    n = len(gains)
    mean = sum(gains) / n
    if mean <= 0.0:
        return "reject"
    sure = n >= FEWEST_TO_ACCEPT and sum(gain > 0.0 for gain in gains) >= FEWEST_GAINS
    error = _standard_error(gains, mean)
    if sure and mean > (ERRORS_TO_ACCEPT if n < last else ERRORS_AT_THE_END) * error:
        return "accept"
    return "reject" if n >= last else "go on"


def closes(gains: Sequence[float], last: int) -> bool:
    """Whether a rejection is final: nothing was gained anywhere, or it was seen often enough."""
    return len(gains) >= min(FEWEST_TO_CLOSE, last) or not any(gain > 0.0 for gain in gains)


def _standard_error(gains: Sequence[float], mean: float) -> float:
    n = len(gains)
    return sqrt(sum((gain - mean) ** 2 for gain in gains) / (n - 1) / n) if n > 1 else 0.0
