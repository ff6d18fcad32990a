"""Scoring a tree on scenarios that no search has seen."""

from __future__ import annotations

from collections.abc import Callable
from math import nan, sqrt
from typing import TYPE_CHECKING

import numpy as np
from attrs import Factory, field, frozen

from grammarbt.bt import compile_policy
from grammarbt.domain import FIRST_VALIDATION_SCENARIO, Domain, Returns, scenario_numbers
from grammarbt.errors import DomainError
from grammarbt.run.simulator import SerialSimulator, Simulator

if TYPE_CHECKING:
    from collections.abc import Iterator

    from grammarbt.bt import BehaviorTree
    from grammarbt.domain import Scenarios

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
        simulator: simulates; one after the other unless given.
    """

    domain: Domain
    seed: int
    advance: Callable[[int], None] = lambda _: None
    simulator: Simulator = field(default=Factory(lambda self: SerialSimulator(self.domain), takes_self=True))

    def returns(self, tree: BehaviorTree, episodes: int) -> Returns:
        """The returns of the first scenarios, (episodes,); NaN where the simulator failed.

        Raises:
            DomainError: the tree uses a leaf that the domain does not have, or the simulator always fails.
        """
        compile_policy(tree, self.domain.vocabulary.index)
        first, last = FIRST_VALIDATION_SCENARIO, FIRST_VALIDATION_SCENARIO + episodes
        chunks = [scenario_numbers(self.seed, start, min(start + _CHUNK, last)) for start in range(first, last, _CHUNK)]
        found: list[float] = []
        for chunk, simulation in zip(chunks, self.simulator.simulate((tree, chunk) for chunk in chunks), strict=True):
            found += simulation.returns if simulation.status == "ok" else self._one_by_one(tree, chunk)
            if np.isnan(found).all():
                raise DomainError(f"the domain cannot score the tree: {simulation.error}", "repair the domain")
            self.advance(len(chunk))
        return np.array(found)

    def _one_by_one(self, tree: BehaviorTree, scenarios: Scenarios) -> Iterator[float]:
        """The returns of scenarios that failed together; most of them may be well alone."""
        for simulation in self.simulator.simulate((tree, scenarios[at : at + 1]) for at in range(len(scenarios))):
            yield simulation.returns[0] if simulation.status == "ok" else nan

    def score(self, tree: BehaviorTree, episodes: int) -> Score:
        """The tree's mean return on the first scenarios."""
        return score_of(self.returns(tree, episodes))


def score_of(values: Returns) -> Score:
    """Mean and standard error of a sample of shape (n,), of which NaN are left out."""
    values = values[~np.isnan(values)]
    spread = float(values.std(ddof=1)) / sqrt(len(values)) if len(values) > 1 else 0.0
    return Score(float(values.mean()), spread, len(values))
