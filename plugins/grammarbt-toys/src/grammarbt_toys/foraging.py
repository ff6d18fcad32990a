"""Swarm foraging: robots that all follow one tree bring food from sites to a hub.

In the manner of Neupane and Goodrich, "Learning Swarm Behaviors using Grammatical Evolution and Behavior Trees" (IJCAI
2019), with leaves of the same kinds; the world is a square with walls and the hub in its middle.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from grammarbt.bt import Status
from grammarbt.domain import ActionType, ConditionType, Group, Outcome, Reference, Vocabulary
from grammarbt.domain.plain import record
from grammarbt_toys import foraging_kernel
from grammarbt_toys.foraging_world import make_world
from grammarbt_toys.parameters import ForagingParameters
from grammarbt_toys.plain_foraging import PlainForaging
from grammarbt_toys.program import make_program

if TYPE_CHECKING:
    from grammarbt.bt import Policy
    from grammarbt.domain import Episode, Scenarios

_AT_ONCE = frozenset({Status.SUCCESS, Status.FAILURE})
_GO_ON = frozenset({Status.RUNNING, Status.FAILURE})
_ANY = (("thing", ("hub", "site", "food")),)
_PLACE = (("thing", ("hub", "site")),)
_FOOD = (("thing", ("food",)),)

VOCABULARY = Vocabulary(
    (
        Group(
            "foraging",
            actions=(
                ActionType("pick up", "Pick up food next to the robot; fails with full hands.", results=_AT_ONCE),
                ActionType("drop", "Put the food down, at the hub for good; fails with empty hands.", results=_AT_ONCE),
                ActionType(
                    "explore", "Move straight on, with a random turn now and then.", results=frozenset({Status.RUNNING})
                ),
                ActionType("move towards", "Move to where one was seen; fails if unknown or there.", _ANY, _GO_ON),
                ActionType("move away", "Move away from where one was seen; fails if unknown.", _ANY, _GO_ON),
            ),
            conditions=(
                ConditionType("neighbour", "One is in sight.", _ANY),
                ConditionType("carrying", "The robot carries one.", _FOOD),
                ConditionType("droppable", "The robot carries food and is next to one.", _PLACE),
                ConditionType("visited before", "The robot remembers one; a site seen empty is forgotten.", _PLACE),
            ),
        ),
    )
)

_DELIVER = "→( (droppable(thing=hub)) [drop] ) →( (carrying(thing=food)) ?( [move towards(thing=hub)] [explore] ) )"
_TAKE = "→( (neighbour(thing=food)) ?( [pick up] [move towards(thing=food)] ) )"
_RETURN = "→( (visited before(thing=site)) [move towards(thing=site)] )"


class Foraging:
    """Robots bring food to the hub; where they and the sites are and how they explore depends on the scenario."""

    vocabulary = VOCABULARY
    grammar = "general"
    references = (
        Reference("manual", f"?( {_DELIVER} {_TAKE} {_RETURN} [explore] )"),
        Reference("without memory", f"?( {_DELIVER} {_TAKE} [explore] )"),
    )
    depends_on: Literal["behaviour", "tree"] = "behaviour"

    def __init__(self, parameters: ForagingParameters | None = None) -> None:
        self.parameters = parameters or ForagingParameters()
        self.return_range = 0.0, float(self.parameters.sites * self.parameters.food)

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Run one episode per scenario; the return is the pieces of food brought to the hub."""
        program, numbers = make_program(policy), np.array(scenarios, dtype=np.int64)
        p = self.parameters
        world = make_world(p.size, p.robots, p.sites, p.food, p.sight)
        return Outcome(foraging_kernel.simulate(program, world, p.food, p.steps, numbers), program.ticks)

    def episode(self, policy: Policy, scenario: int) -> Episode:
        """The episode that `simulate` scores; each robot's tick is a frame of its own."""
        world = PlainForaging(self.parameters, scenario)
        return record(world, policy.tree, world.box, "pieces of food")
