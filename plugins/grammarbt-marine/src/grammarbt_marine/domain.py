"""The marine domain: the vocabulary and the compiled simulator, as grammarbt wants them."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from grammarbt.domain import Outcome, Reference
from grammarbt_marine import kernel
from grammarbt_marine.parameters import MarineParameters
from grammarbt_marine.rules import make_rules
from grammarbt_marine.state import make_states
from grammarbt_marine.vocabulary import VOCABULARY
from grammarbt_marine.world import make_roadmaps

if TYPE_CHECKING:
    from grammarbt.bt import Policy
    from grammarbt.domain import Scenarios
    from grammarbt_marine.records import Records

_REPORT = "→( (target found) ?( (in comms) [go to comms] ) [report] )"
_DISARM = "→( (mine found) (is armed) [disarm] )"
_RETRIEVE = "→( (object found) ?( (carrying object) [pick up] ) [take to drop off] )"
_APPROACH = "→( (likely target found) [go to likely target] )"
_EXPLORE = "→( [shortest path] )"
_WANDER = "→( [random walk] )"

_CODES = np.array([kernel.LEAVES.index(leaf.name) for leaf in VOCABULARY.leaves], dtype=np.int32)


class Marine:
    """A robot on a roadmap over a sea area reports targets, disarms mines and retrieves objects.

    Scenario i uses roadmap i modulo `parameters.roadmaps`; where things are and what the sensors see depends on i.
    """

    vocabulary = VOCABULARY
    grammar = "marine"
    references = (
        Reference("manual", f"?( {_REPORT} {_DISARM} {_RETRIEVE} {_APPROACH} {_EXPLORE} {_WANDER} )"),
        Reference("best order", f"?( {_DISARM} {_RETRIEVE} {_APPROACH} {_REPORT} {_EXPLORE} {_WANDER} )"),
    )
    depends_on: Literal["behaviour", "tree"] = "behaviour"

    def __init__(self, parameters: MarineParameters | None = None) -> None:
        self.parameters = parameters or MarineParameters()

    @cached_property
    def roadmaps(self) -> Records:
        """The tables of all roadmaps, as records; made when first needed."""
        return make_roadmaps(self.parameters)

    @cached_property
    def rules(self) -> Records:
        """The numbers of an episode, as one record."""
        return make_rules(self.parameters)

    @cached_property
    def _states(self) -> Records:
        return make_states(self.parameters.vertices)

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Run one episode per scenario."""
        program = _program(policy)
        states = np.empty_like(self._states)  # its own, so that threads may share the domain
        numbers = np.array(scenarios, dtype=np.int64)  # read-only or strided arrays would be compiled for anew
        return Outcome(*kernel.simulate(program, states, self.roadmaps, self.rules, numbers))


def _program(policy: Policy) -> kernel.Program:
    entries = np.empty(len(policy.leaf), dtype=kernel.ENTRY)
    entries["leaf"] = _CODES[policy.leaf]
    entries["occurrence"] = policy.occurrence
    follow = entries["follow"]
    follow[:, kernel.SUCCESS] = policy.on_success
    follow[:, kernel.FAILURE] = policy.on_failure
    follow[:, kernel.RUNNING] = policy.on_running
    return kernel.Program(entries, policy.occurrences)
