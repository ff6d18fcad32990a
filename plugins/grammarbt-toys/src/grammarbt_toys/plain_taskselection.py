"""Task selection in plain Python: to compare with, and to watch, an assignment a tick."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import prod

from grammarbt.bt import Action, Leaf, Status
from grammarbt.domain import Mark

BOX_ABOVE = 3.0


class PlainTaskSelection:
    """Counts through the truth assignments of c0 to c`last`, c0 the quickest; one tick each."""

    def __init__(self, last: int) -> None:
        self.last = last
        self.assignment, self.right, self.done = 0, 0, False
        self.chosen: str | None = None
        self._ended = ""
        self._marks = tuple(self._draw("", self._truth()))

    @property
    def box(self) -> tuple[float, float, float, float]:
        """A column for each condition, and above them the actions."""
        return -1.0, -1.0, self.last + 1.0, BOX_ABOVE

    @property
    def reward(self) -> float:
        """The share of right actions among the assignments so far."""
        return self.right / max(self.assignment, 1)

    def answer(self, leaf: Leaf, _: int) -> Status:
        """Actions stay running, and the first one counts."""
        if isinstance(leaf, Action):
            self.chosen = self.chosen or leaf.name
            return Status.RUNNING
        return Status.SUCCESS if self._truth()[int(leaf.name[1:])] else Status.FAILURE

    def step(self, _: Status | None) -> None:
        """Go on to the next assignment."""
        truth, wanted = self._truth(), f"a{right_action(self._truth())}"
        self._ended = "" if self.chosen == wanted else f"wrong: {self.chosen or 'nothing'} instead of {wanted}"
        self._marks = tuple(self._draw(self.chosen or "nothing", truth))
        self.right += self.chosen == wanted
        self.assignment, self.chosen = self.assignment + 1, None
        self.done = self.assignment == 2 ** (self.last + 1)

    def picture(self) -> Sequence[Mark]:
        """The assignment that was just decided, the right action, and the chosen one."""
        return self._marks

    def events(self) -> Sequence[str]:
        """Whether the action was wrong."""
        return (self._ended,) if self._ended else ()

    def _truth(self) -> tuple[bool, ...]:
        return truth_of(self.assignment, self.last)

    def _draw(self, chosen: str, truth: tuple[bool, ...]) -> Iterator[Mark]:
        wanted = f"a{right_action(truth)}"
        for number, holds in enumerate(truth):
            label = f"c{number} {'holds' if holds else 'does not'}"
            yield Mark(f"c{number}", "square", "place", number, 0.0, 0.6, 1.0 if holds else 0.2, label)
        yield Mark("right", "text", "goal", 0.0, 2.0, 0.4, label=f"right: {wanted}")
        yield Mark("chosen", "text", "robot" if chosen in {"", wanted} else "hazard", 0.0, 1.2, 0.4, label=chosen)


def truth_of(assignment: int, last: int) -> tuple[bool, ...]:
    """Whether c0 to c`last` hold: bit i of the assignment says whether ci does."""
    return tuple(bool(assignment >> number & 1) for number in range(last + 1))


def right_action(truth: Sequence[bool]) -> int:
    """The number of the right action where these conditions hold."""
    return 0 if truth[0] else prod(number for number, holds in enumerate(truth) if holds)
