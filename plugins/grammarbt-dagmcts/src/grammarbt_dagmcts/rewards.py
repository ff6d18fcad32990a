"""What the nodes of a DAG have brought, as columns of numbers."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterable
from math import sqrt
from typing import TypeAlias

from grammarbt.search import Arm, Bandit, Ucb1

NEVER_ZERO = 1e-9
"""What is added to pulls, as one divides by them."""

Selections: TypeAlias = "tuple[array[int], Callable[[], float]]"


class Rewards:
    """Shows rules one node at a time as an arm.

    Attributes:
        visits: per node, how many rewards.
        total: per node, their sum.
    """

    def __init__(self) -> None:
        self.visits = array("I")
        self.total = array("d")
        self._squares = array("d")
        self._kept: dict[int, list[float]] = {}
        self._arm = Arm()

    def add_node(self) -> None:
        """Make room for one more node."""
        self.visits.append(0)
        self.total.append(0.0)
        self._squares.append(0.0)

    def arm(self, node: int) -> Arm:
        """The node as a rule sees it, until the next one is asked for."""
        arm = self._arm
        arm.visits, arm.total, arm.squares = self.visits[node], self.total[node], self._squares[node]
        if self._kept or arm.kept:
            arm.kept = self._kept.get(node) or []
        return arm

    def credit(self, nodes: Iterable[int], bandit: Bandit, reward: float) -> None:
        """Give each node the reward observed last."""
        if isinstance(bandit, Ucb1):
            self._count(nodes, reward)
            return
        for node in nodes:
            arm = self.arm(node)
            bandit.credit(arm, reward)
            self.visits[node], self.total[node], self._squares[node] = arm.visits, arm.total, arm.squares
            if arm.kept:
                self._kept[node] = arm.kept

    def _count(self, nodes: Iterable[int], reward: float) -> None:
        """What UCB1 credits, without arms in between: most of the time it is asked for."""
        visits, total, squares, squared = self.visits, self.total, self._squares, reward * reward
        for node in nodes:
            visits[node] += 1
            total[node] += reward
            squares[node] += squared

    def most_urgent(self, nodes: Iterable[int], bandit: Bandit, selections: Selections, trials: int) -> int:
        """The place of the node with the highest index, the first of equals; all have rewards.

        Args:
            nodes: the arms.
            bandit: the rule.
            selections: per node, how often it was pulled; and what gives a random number to add to it.
            trials: pulls of all of them.
        """
        pulled, draw = selections
        if not isinstance(bandit, Ucb1):
            indices = [bandit.index(self.arm(node), pulled[node] + draw() + NEVER_ZERO, trials) for node in nodes]
            return indices.index(max(indices))
        visits, total, (scale, twice_log) = self.visits, self.total, bandit.bonus(trials)
        best, highest = 0, float("-inf")
        for place, node in enumerate(nodes):  # most of a selection's time is spent here
            index = total[node] / visits[node] + scale * sqrt(twice_log / (pulled[node] + draw() + NEVER_ZERO))
            if index > highest:
                best, highest = place, index
        return best

    def mean(self, node: int) -> float:
        """Mean reward; 0 before the first."""
        return self.total[node] / self.visits[node] if self.visits[node] else 0.0
