"""A simulator in plain Python: say what a leaf does, and the ticking is done for you."""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import partial
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np

from grammarbt.bt import (
    Action,
    BehaviorTree,
    Leaf,
    Policy,
    Status,
    compile_source,
    flatten,
    format_leaf,
    leaves,
    ticker,
)
from grammarbt.domain.base import Outcome, Reference, Scenarios
from grammarbt.domain.episode import Drawing, Episode, Frame, Mark
from grammarbt.errors import DomainError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from grammarbt.bt import Ticker
    from grammarbt.bt.vocabulary import Vocabulary

_LONG = 1_000
"""How often leaves are ticked, per leaf of the tree, before compiling generated source has paid for itself."""


class TickDomain(ABC):
    """Base of domains written as a world with a state.

    Each episode: `reset(rng)`, then ticks until `done`; after each tick `step()` lets the world move on. The return is
    `reward` at the end. To let people watch, draw the world in `picture`.
    """

    vocabulary: ClassVar[Vocabulary]
    grammar: ClassVar[str] = "general"
    references: ClassVar[tuple[Reference, ...]] = ()
    depends_on: ClassVar[Literal["behaviour", "tree"]] = "behaviour"

    reward: float = 0.0
    done: bool = False
    box: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0)
    unit: str = ""

    @abstractmethod
    def reset(self, rng: np.random.Generator) -> None:
        """Make a fresh world; draw all that is random from `rng`, also later in the episode."""

    @abstractmethod
    def condition(self, name: str, **arguments: str) -> bool:
        """Whether the condition holds now."""

    @abstractmethod
    def action(self, name: str, **arguments: str) -> Status:
        """Do one step of the action and say how it went."""

    @abstractmethod
    def step(self) -> None:
        """Let time pass after a tick; set `done` when the episode is over."""

    def picture(self) -> Sequence[Mark]:
        """The world as it is now, within `box`; nothing unless overridden."""
        return ()

    def events(self) -> Sequence[str]:
        """What is worth stopping at in the last tick, in words; nothing unless overridden."""
        return ()

    def simulate(self, policy: Policy, scenarios: Scenarios) -> Outcome:
        """Run one episode per scenario; a simulation that turns out long goes on in generated source."""
        asked = _Leaves(self, policy.tree)
        tick = ticker(flatten(policy.tree))
        returns, generated = [], False
        for scenario in scenarios:
            if not generated and sum(asked.ticks) > _LONG * len(asked.ticks):
                tick, generated = compile_source(policy.tree), True
            returns.append(_play(self, tick, asked, int(scenario)))
        return Outcome(np.array(returns, dtype=np.float64), np.array(asked.ticks, dtype=np.int64))

    def episode(self, policy: Policy, scenario: int) -> Episode:
        """The episode that `simulate` scores, with all that happens in it."""
        asked = _RecordedLeaves(self, policy.tree)
        tick = ticker(flatten(policy.tree))
        _begin(self, scenario)
        marks, frames = tuple(self.picture()), []
        drawing = Drawing(marks)
        while not self.done:
            asked.answers = []
            tick(asked)
            self.step()
            changes = drawing.changes(self.picture())
            frames.append(Frame(tuple(asked.answers), float(self.reward), changes, tuple(self.events())))
        return Episode(tuple(frames), marks, self.box, self.unit)


def _begin(world: TickDomain, scenario: int) -> None:
    world.reward, world.done = 0.0, False
    world.reset(np.random.default_rng(scenario))


def _play(world: TickDomain, tick: Ticker, asked: _Leaves, scenario: int) -> float:
    _begin(world, scenario)
    while not world.done:
        tick(asked)
        world.step()
    return world.reward


class _Leaves:
    """Asks a world about a tree's leaves by their occurrence.

    Attributes:
        ticks: how often each leaf was asked.
    """

    def __init__(self, world: TickDomain, tree: BehaviorTree) -> None:
        self._leaves = leaves(tree)
        self._asking = [_asking(world, leaf) for leaf in self._leaves]
        self.ticks = [0] * len(self._leaves)

    def __getitem__(self, occurrence: int) -> int:
        self.ticks[occurrence] += 1
        ask, name, kind = self._asking[occurrence]
        answer = ask(name)
        return answer if answer.__class__ is kind else _status(self._leaves[occurrence], answer)


class _RecordedLeaves(_Leaves):
    """Keeps the answers, in order."""

    answers: list[tuple[int, Status]]

    def __getitem__(self, occurrence: int) -> int:
        answer = super().__getitem__(occurrence)
        self.answers.append((occurrence, Status(answer)))
        return answer


def _asking(world: TickDomain, leaf: Leaf) -> tuple[Callable[[str], int], str, type[int]]:
    """What to call, with which name, and the type of a plain answer."""
    ask: Callable[..., int] = world.action if isinstance(leaf, Action) else world.condition
    return (
        partial(ask, **dict(leaf.arguments)) if leaf.arguments else ask,
        leaf.name,
        Status if isinstance(leaf, Action) else bool,
    )


def _status(leaf: Leaf, answer: object) -> Status:
    """What an unusual answer means: a condition's may be anything that is true or false, an action's must be a status."""
    if isinstance(leaf, Action):
        raise DomainError(f"{format_leaf(leaf)} answered {answer!r}", "return a Status from `action`")
    return Status.SUCCESS if answer else Status.FAILURE
