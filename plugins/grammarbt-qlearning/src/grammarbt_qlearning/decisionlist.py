"""Policies over truth values as short trees: a decision list is a fallback of sequences of conditions and an action."""

from __future__ import annotations

from collections.abc import Sequence as Row
from itertools import product

import numpy as np
from attrs import field, frozen
from numpy.typing import NDArray

from grammarbt.bt import Action, BehaviorTree, Condition, Fallback, Not, Sequence

Flags = NDArray[np.bool_]
Numbers = NDArray[np.int64]

Test = tuple[int, ...]
"""Per condition: 1 must hold, 0 must not hold, -1 makes no difference."""


@frozen(eq=False)
class Rule:
    """A row of a decision list.

    Attributes:
        test: which states it is about, but for those of earlier rules.
        action: what is done there.
        states: (states,) those that the list needs it for.
    """

    test: Test
    action: int
    states: Flags = field(repr=False)


class DecisionLists:
    """Finds short decision lists (Rivest, "Learning Decision Lists", Machine Learning 1987) for policies.

    A state is a truth assignment; bit i of its number is the truth of condition i.

    Args:
        conditions: of the policies.
        actions: of the policies.
    """

    def __init__(self, conditions: Row[Condition], actions: Row[Action]) -> None:
        self.conditions = tuple(conditions)
        self.actions = tuple(actions)
        self.truth = np.arange(2 ** len(conditions))[:, None] >> np.arange(len(conditions)) & 1
        self._tests = sorted(product((-1, 1, 0), repeat=len(conditions)), key=lambda test: -test.count(-1))
        self._covers = np.array([self._covered(test) for test in self._tests])
        self._sizes = self._covers.astype(np.int64)

    def _covered(self, test: Test) -> Flags:
        wanted = np.array(test, dtype=np.int64)
        covered: Flags = ((wanted < 0) | (self.truth == wanted)).all(axis=1)
        return covered

    def rules(self, policy: Numbers, free: Flags) -> list[Rule]:
        """Separate and conquer: the test that covers most states of one action comes first, the shortest of several.

        Args:
            policy: (states,) the number of each state's action.
            free: (states,) where any action will do.
        """
        left = ~free
        found: list[Rule] = []
        while len(np.unique(policy[left])) > 1 or not found:
            counts = np.stack([self._sizes @ (left & (policy == one)) for one in range(len(self.actions))], axis=1)
            pure = np.where(np.count_nonzero(counts, axis=1) <= 1, counts.max(axis=1), -1)
            if not found and len(np.unique(policy[left])) <= 1:
                pure[0] = -1  # a policy of one action: its list has two rules all the same, as grammars ask for a test
            at = int(pure.argmax())
            states = self._covers[at] & left
            found.append(Rule(self._tests[at], int(counts[at].argmax()), states))
            left = left & ~states
        default = int(policy[left][0]) if left.any() else found[-1].action
        return [*found, Rule((-1,) * len(self.conditions), default, left)]

    def tree(self, rules: Row[Rule]) -> BehaviorTree:
        """The fallback of the rules; the last one's action stands alone."""
        rows = [Sequence((*self._checks(rule.test), self.actions[rule.action])) for rule in rules[:-1]]
        return Fallback((*rows, self.actions[rules[-1].action]))

    def _checks(self, test: Test) -> list[Condition | Not]:
        pairs = zip(self.conditions, test, strict=True)
        return [condition if wanted else Not(condition) for condition, wanted in pairs if wanted >= 0]
