"""What a simulator is, to grammarbt.

A *scenario* is one integer: it fixes the world and all its noise, for every tree alike, so that two trees can be
compared pair by pair. Scenarios of different run seeds never coincide.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Protocol, TypeAlias

import numpy as np
from attrs import frozen
from numpy.typing import NDArray

from grammarbt.errors import DomainError

if TYPE_CHECKING:
    from grammarbt.bt import Policy
    from grammarbt.bt.vocabulary import Vocabulary

Scenarios: TypeAlias = NDArray[np.int64]
"""(n,) numbers of scenarios; each fixes a world and all its noise."""

Returns: TypeAlias = NDArray[np.float64]
"""(n,) returns, one per scenario."""

SCENARIOS_PER_SEED = 2**32
"""Numbers set apart for each run seed."""

FIRST_VALIDATION_SCENARIO = 2**31
"""Of a run seed's scenarios, those from this one on are for validation; no search sees them."""

MAX_SEED = 2**31 - 1
"""The largest run seed, so that every scenario fits into 64 bits."""


def scenario_numbers(seed: int, start: int, stop: int) -> Scenarios:
    """Scenarios `start` to `stop` (exclusive) of a run seed.

    Searching uses those below `FIRST_VALIDATION_SCENARIO`, validation those from it on.
    """
    if not 0 <= seed <= MAX_SEED:
        raise DomainError(f"seed {seed} is out of range", f"choose one from 0 to {MAX_SEED}")
    return np.arange(start, stop, dtype=np.int64) + np.int64(seed * SCENARIOS_PER_SEED)


@frozen(eq=False)
class Outcome:
    """What simulating a policy on n scenarios gave.

    Attributes:
        returns: (n,) the return of each episode, in the order of the scenarios.
        ticks: (occurrences,) how often each leaf of the tree was ticked, over all episodes.
    """

    returns: Returns
    ticks: NDArray[np.int64]


@frozen
class Reference:
    """A tree to compare with, in the one-line notation."""

    name: str
    tree: str


class Domain(Protocol):
    """A simulator that scores trees.

    Attributes:
        vocabulary: the leaves it understands.
        grammar: the default grammar: a name, or the text itself.
        references: trees to compare with; the first is the one `run` reports.
        depends_on: `"behaviour"` when two trees that behave alike have the same return, `"tree"` when the tree itself
            matters (its size costs, or a node keeps memory).
    """

    vocabulary: Vocabulary
    grammar: str
    references: tuple[Reference, ...]
    depends_on: Literal["behaviour", "tree"]

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Simulate one episode per scenario; the same scenario always gives the same return."""
        ...


@frozen
class NoParameters:
    """The parameters of a component that has none."""
