"""What the nodes of a DAG have brought, as columns of numbers."""

from __future__ import annotations

from array import array
from collections.abc import Iterable

from grammarbt.search import Arm, Bandit


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
        for node in nodes:
            arm = self.arm(node)
            bandit.credit(arm, reward)
            self.visits[node], self.total[node], self._squares[node] = arm.visits, arm.total, arm.squares
            if arm.kept:
                self._kept[node] = arm.kept

    def mean(self, node: int) -> float:
        """Mean reward; 0 before the first."""
        return self.total[node] / self.visits[node] if self.visits[node] else 0.0
