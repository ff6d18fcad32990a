"""A simulator that misbehaves in the worlds it is told to."""

import os
import signal
import time
from zlib import crc32

import attrs
import numpy as np

from grammarbt.bt import format_tree
from grammarbt.domain import ActionType, ConditionType, Group, Outcome, Vocabulary

_LEAKED = []


@attrs.frozen
class Faulty:
    """For every nth tree and world something goes wrong; 0 for never. And each world leaks so many MB."""

    raises: int = 0
    nan: int = 0
    shape: int = 0
    hangs: int = 0
    exits: int = 0
    crashes: int = 0
    swells: int = 0
    leak: int = 0
    flaky: str = ""
    broken: str = ""
    vocabulary = Vocabulary((Group("g", (ActionType("a"), ActionType("b")), (ConditionType("c"), ConditionType("d"))),))
    grammar = "general"
    references = ()
    depends_on = "tree"

    def simulate(self, policy, scenarios):
        returns = np.array([float(scenario % 97) for scenario in scenarios])
        tree = crc32(format_tree(policy.tree).encode())
        for scenario in scenarios.tolist():
            self._misbehave(tree + scenario, returns)
        wrong = any(self._due(self.shape, tree + scenario) for scenario in scenarios.tolist())
        return Outcome(returns[wrong:], np.zeros(policy.occurrences, dtype=np.int64))

    def _misbehave(self, number, returns):
        if self._due(self.raises, number) or (self.broken and os.path.exists(self.broken)):  # noqa: PTH110 - as below
            raise ValueError(f"world {number} is broken")
        if self._due(self.nan, number):
            returns[:] = np.nan
        if self._due(self.hangs, number):
            time.sleep(60)
        if self._due(self.swells, number):
            _LEAKED.append(np.ones(3 * 10**7))
            time.sleep(60)
        if self.leak:
            _LEAKED.append(np.ones(self.leak * 10**6 // 8))
        if self._due(self.exits, number) or self._first_time():
            os._exit(3)
        if self._due(self.crashes, number):
            os.kill(os.getpid(), signal.SIGSEGV)

    def _first_time(self):
        """Whether nobody has left a mark yet; leaves one."""
        if not self.flaky or os.path.exists(self.flaky):  # noqa: PTH110 - a file that a dying process can make
            return False
        with open(self.flaky, "w"):  # noqa: PTH123
            return True

    @staticmethod
    def _due(every, number):
        return every and number % every == 0
