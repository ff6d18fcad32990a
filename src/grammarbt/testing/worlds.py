"""Small worlds in which searchers are tested: quick, exact, and easy to reason about."""

from __future__ import annotations

import numpy as np

from grammarbt.bt import Status
from grammarbt.domain import ActionType, ConditionType, Group, Reference, TickDomain, Vocabulary

DONE = frozenset({Status.SUCCESS})
LAMPS = ("red", "green", "blue")

FINITE = """\
%declare ACTION CONDITION
start: "?" "(" task task? task? ")"
task: "→" "(" check ACTION ")"
check: CONDITION | "!" "(" CONDITION ")"
"""

TINY = """\
%declare ACTION
start: "→" "(" ACTION ACTION ")"
"""

INFINITE = """\
%declare ACTION CONDITION
start: tree
tree: "?" "(" child child+ ")" | "→" "(" child child+ ")"
child: tree | ACTION @ 6 | CONDITION @ 3
"""


class Lamps(TickDomain):
    """Three lamps and three ticks; a lamp lit by an action pays once, and each scenario has its own prices."""

    vocabulary = Vocabulary(
        tuple(
            Group(
                lamp,
                (ActionType(f"light {lamp}", f"Light the {lamp} lamp.", results=DONE),),
                (ConditionType(f"{lamp} lit", f"Whether the {lamp} lamp is lit."),),
            )
            for lamp in LAMPS
        )
    )
    grammar = FINITE
    references = (
        Reference(
            "all", "?( →( !(red lit) [light red] ) →( !(green lit) [light green] ) →( !(blue lit) [light blue] ) )"
        ),
    )

    def reset(self, rng: np.random.Generator) -> None:
        """All dark."""
        self.lit = dict.fromkeys(LAMPS, False)
        self.price = dict(zip(LAMPS, rng.normal(10.0, 1.0, len(LAMPS)).tolist(), strict=True))
        self.ticks = 0

    def condition(self, name: str, **arguments: str) -> bool:
        """Whether a lamp is lit."""
        del arguments
        return self.lit[name.removesuffix(" lit")]

    def action(self, name: str, **arguments: str) -> Status:
        """Light a lamp."""
        del arguments
        self.lit[name.removeprefix("light ")] = True
        return Status.SUCCESS

    def step(self) -> None:
        """Three ticks are an episode."""
        self.ticks += 1
        self.done = self.ticks == len(LAMPS)
        self.reward = sum(price for lamp, price in self.price.items() if self.lit[lamp])
