"""Scoring a tree on scenarios that no search has seen."""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt
from typing import TYPE_CHECKING

import numpy as np
from attrs import frozen

from grammarbt.bt import compile_policy
from grammarbt.domain import FIRST_VALIDATION_SCENARIO, Domain, Returns, scenario_numbers
from grammarbt.errors import DomainError
from grammarbt.run.simulate import simulate

if TYPE_CHECKING:
    from grammarbt.bt import BehaviorTree

_CHUNK = 100
"""Episodes between two looks at the keyboard and the progress."""


@frozen
class Score:
    """A mean and its standard error, in the domain's unit of return."""

    mean: float
    stderr: float
    episodes: int


@frozen(eq=False)
class Validator:
    """Simulates trees on the validation scenarios of a seed, the same for every tree.

    Args:
        domain: the simulator.
        seed: which scenarios.
        advance: told of the episodes as they are simulated.
    """

    domain: Domain
    seed: int
    advance: Callable[[int], None] = lambda _: None

    def returns(self, tree: BehaviorTree, episodes: int) -> Returns:
        """The returns of the first scenarios, (episodes,).

        Raises:
            DomainError: the tree uses a leaf that the domain does not have, or the simulator fails.
        """
        policy = compile_policy(tree, self.domain.vocabulary.index)
        found: list[float] = []
        while len(found) < episodes:
            start = FIRST_VALIDATION_SCENARIO + len(found)
            stop = min(start + _CHUNK, FIRST_VALIDATION_SCENARIO + episodes)
            simulation = simulate(self.domain, policy, scenario_numbers(self.seed, start, stop))
            if simulation.status != "ok":
                raise DomainError(f"the domain cannot score the tree: {simulation.error}", "repair the domain")
            found += simulation.returns
            self.advance(stop - start)
        return np.array(found)

    def score(self, tree: BehaviorTree, episodes: int) -> Score:
        """The tree's mean return on the first scenarios."""
        return score_of(self.returns(tree, episodes))


def score_of(values: Returns) -> Score:
    """Mean and standard error of a sample of shape (n,)."""
    spread = float(values.std(ddof=1)) / sqrt(len(values)) if len(values) > 1 else 0.0
    return Score(float(values.mean()), spread, len(values))
