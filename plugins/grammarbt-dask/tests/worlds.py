"""A simulator that takes its time, says which processes it runs in, and ends them for some of the trees."""

import os
import time
from pathlib import Path
from zlib import crc32

import attrs
import numpy as np

from grammarbt.bt import format_tree
from grammarbt.domain import ActionType, ConditionType, Group, Outcome, Vocabulary


@attrs.frozen(slots=False)
class World:
    """The return is the scenario's number modulo 97; an episode takes `seconds`, every `deadly`th tree kills."""

    seconds: float = 0.0
    marks: str = ""
    deadly: int = 0
    vocabulary = Vocabulary((Group("g", (ActionType("a"), ActionType("b")), (ConditionType("c"), ConditionType("d"))),))
    grammar = "general"
    references = ()
    depends_on = "tree"

    def __attrs_post_init__(self):
        if self.marks:
            with Path(self.marks).open("a") as file:
                file.write(f"{os.getpid()}\n")

    def simulate(self, policy, scenarios):
        if self.deadly and crc32(format_tree(policy.tree).encode()) % self.deadly == 0:
            os._exit(3)
        time.sleep(self.seconds * len(scenarios))
        return Outcome(np.array(scenarios % 97, dtype=float), np.ones(policy.occurrences, dtype=np.int64))
