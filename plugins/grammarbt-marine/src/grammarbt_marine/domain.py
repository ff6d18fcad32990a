"""The marine domain: the vocabulary and the compiled simulator, as grammarbt wants them."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from grammarbt.domain import Outcome
from grammarbt_marine.kernel.episodes import simulate
from grammarbt_marine.parameters import MarineParameters
from grammarbt_marine.program import LEAVES, make_program
from grammarbt_marine.references import EXTENDED_REFERENCES, REFERENCES
from grammarbt_marine.rules import make_rules
from grammarbt_marine.state import Episodes, Room, make_room
from grammarbt_marine.vocabulary import EXTENDED_VOCABULARY, VOCABULARY
from grammarbt_marine.world import make_roadmaps

if TYPE_CHECKING:
    from grammarbt.bt import Policy
    from grammarbt.domain import Episode, Scenarios
    from grammarbt_marine.records import Records


class Marine:
    """Robots on a roadmap over a sea area report targets, disarm mines and retrieve objects.

    Scenario i uses roadmap i modulo `parameters.roadmaps`; where things are and what the sensors see depends on i.
    """

    grammar = "marine"
    depends_on: Literal["behaviour", "tree"] = "behaviour"

    def __init__(self, parameters: MarineParameters | None = None) -> None:
        self.parameters = parameters or MarineParameters()
        extended = self.parameters.extra_leaves
        self.vocabulary = EXTENDED_VOCABULARY if extended else VOCABULARY
        self.references = EXTENDED_REFERENCES if extended else REFERENCES
        self._codes = np.array([LEAVES.index(leaf.name) for leaf in self.vocabulary.leaves], dtype=np.int32)

    @cached_property
    def roadmaps(self) -> Records:
        """The tables of all roadmaps, as records; made when first needed."""
        return make_roadmaps(self.parameters)

    @cached_property
    def rules(self) -> Records:
        """The numbers of an episode, as one record."""
        return make_rules(self.parameters)

    @cached_property
    def _room(self) -> Room:
        return make_room(self.parameters)

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Run one episode per scenario."""
        program = make_program(policy, self._codes)
        room = Room(*map(np.empty_like, self._room))  # its own, so that threads may share the domain
        numbers = np.array(scenarios, dtype=np.int64)  # read-only or strided arrays would be compiled for anew
        episodes = Episodes(numbers, np.empty(numbers.shape))
        simulate(program, room, self.roadmaps, self.rules, episodes)
        return Outcome(episodes.returns, program.ticks)

    def episode(self, policy: Policy, scenario: int) -> Episode:
        """Record the episode that `simulate` scores, by the simulator in plain Python."""
        from grammarbt_marine.recording import record  # noqa: PLC0415 - only to watch, and it is the domain's user

        return record(self, policy.tree, scenario)
