"""Task selection: choose the right action for what holds; as large as one likes, and exact.

There are conditions c0, c1 … cN and actions a0, a1 … up to the product of the numbers 1 to N. The right action is a0
where c0 holds; elsewhere its number is the product of the numbers of the conditions that hold, 1 if there are none. A
tree is ticked once in each of the 2^(N+1) truth assignments; its return is the share in which the first action it ticks
is the right one.
"""

from __future__ import annotations

from itertools import combinations
from math import factorial, prod
from typing import TYPE_CHECKING, Literal

import numpy as np

from grammarbt.bt import Action, Condition, Fallback, Sequence, Status, format_tree
from grammarbt.domain import ActionType, ConditionType, Group, Outcome, Reference, Vocabulary
from grammarbt.domain.plain import record
from grammarbt_toys.parameters import TaskSelectionParameters
from grammarbt_toys.plain_taskselection import PlainTaskSelection, right_action, truth_of
from grammarbt_toys.program import make_program
from grammarbt_toys.taskselection_kernel import first_actions

if TYPE_CHECKING:
    from grammarbt.bt import BehaviorTree, Policy
    from grammarbt.domain import Episode, Scenarios


class TaskSelection:
    """Whether a tree chooses the right action in every truth assignment; all scenarios are the same."""

    grammar = "taskselection"
    depends_on: Literal["behaviour", "tree"] = "behaviour"
    return_range = (0.0, 1.0)

    def __init__(self, parameters: TaskSelectionParameters | None = None) -> None:
        self.parameters = parameters or TaskSelectionParameters()
        last = self.parameters.conditions
        self.vocabulary = make_vocabulary(last)
        self.references = (Reference("constructed", format_tree(right_tree(last))),)
        self._right = np.array([right_action(truth_of(number, last)) for number in range(2 ** (last + 1))])

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Tick once in every assignment; the same for every scenario."""
        program, last = make_program(policy), self.parameters.conditions
        chosen = first_actions(program, last + 1, factorial(last) + 1)
        returns = np.full(len(scenarios), np.mean(chosen == self._right))
        return Outcome(returns, program.ticks * len(scenarios))

    def episode(self, policy: Policy, _scenario: int) -> Episode:
        """The episode that `simulate` scores, an assignment a tick."""
        world = PlainTaskSelection(self.parameters.conditions)
        return record(world, policy.tree, world.box, "share of right actions")


def make_vocabulary(last: int) -> Vocabulary:
    """Conditions c0 to c`last` and an action for every number that they could ask for, in one group."""
    running = frozenset({Status.RUNNING})
    actions = (ActionType(f"a{number}", f"Do task {number}.", results=running) for number in range(factorial(last) + 1))
    conditions = (ConditionType(f"c{number}", f"Condition {number} holds.") for number in range(last + 1))
    return Vocabulary((Group("tasks", tuple(actions), tuple(conditions)),))


def right_tree(last: int) -> BehaviorTree:
    """A tree that is right in every assignment.

    A fallback: first c0 with a0. Then one sequence for every set of the conditions c2 to c`last`, the larger sets first:
    when a sequence's conditions are the first that all hold, no further condition of these holds, or a larger set would
    have come before; so the product of their numbers is the right action. c1 changes no product, and needs no test.
    The empty set comes last and leaves a1 alone, the default.
    """
    sizes = range(last - 1, 0, -1)
    sets = [numbers for size in sizes for numbers in combinations(range(2, last + 1), size)]
    return Fallback((_guarded((0,), 0), *(_guarded(numbers, prod(numbers)) for numbers in sets), Action("a1")))


def _guarded(numbers: tuple[int, ...], action: int) -> BehaviorTree:
    return Sequence((*(Condition(f"c{number}") for number in numbers), Action(f"a{action}")))
