"""Evaluating proposals: known returns are looked up, only the missing episodes are simulated."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from attrs import frozen

from grammarbt.bt import BehaviorTree, format_tree
from grammarbt.bt.canonical import canonical_key
from grammarbt.domain import Domain, scenario_numbers
from grammarbt.run.replay import Replay
from grammarbt.run.simulate import Simulation
from grammarbt.run.simulator import Simulator, serial_simulator
from grammarbt.search import Evaluation, Proposal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from grammarbt.domain import Scenarios


@frozen
class Trial:
    """An evaluation, and how many of its episodes had to be simulated."""

    evaluation: Evaluation
    simulated: int


@frozen(eq=False)
class Task:
    """A proposal with the returns known of its tree, and the scenarios whose returns are missing."""

    proposal: Proposal
    known: dict[int, float]
    missing: Sequence[int]

    def trial(self, simulation: Simulation) -> Trial:
        """The trial, now that the missing scenarios are simulated; remembers their returns."""
        return Trial(self._evaluation(simulation), len(self.missing))

    def _evaluation(self, simulation: Simulation) -> Evaluation:
        proposal = self.proposal
        if simulation.status != "ok":
            return Evaluation(proposal, (), (), simulation.status, simulation.error)
        self.known.update(zip(self.missing, simulation.returns, strict=True))
        returns = tuple(self.known[number] for number in range(proposal.start, proposal.stop))
        return Evaluation(proposal, returns, simulation.ticks)


class Evaluator:
    """Scores trees on a domain and remembers every return.

    Args:
        domain: the simulator.
        seed: the run's seed; with a scenario's number it fixes the world.
        replay: answers the first proposals instead of the simulator, when the run goes on from a journal.
        simulator: simulates; one after the other unless given.

    Attributes:
        episodes: episodes simulated so far, those of the journal included.
    """

    def __init__(
        self, domain: Domain, seed: int, replay: Replay | None = None, simulator: Simulator | None = None
    ) -> None:
        self.episodes = 0
        self.replay = Replay() if replay is None else replay
        self._simulator = simulator or serial_simulator(domain)
        self._first = int(scenario_numbers(seed, 0, 1)[0])
        self._key = tree_key(domain)
        self._known: dict[bytes, dict[int, float]] = {}

    def key(self, tree: BehaviorTree) -> bytes:
        """Equal for trees that always have the same return."""
        return self._key(tree)

    def known(self, tree: BehaviorTree) -> tuple[float, ...]:
        """Every return known of a tree, in the order simulated."""
        return tuple(self._known.get(self._key(tree), {}).values())

    def evaluate(self, proposals: Sequence[Proposal], limit: int) -> list[Trial]:
        """Evaluate proposals in order until the next would simulate more than `limit` episodes in all."""
        trials: dict[int, Trial] = {}
        left = dict(enumerate(proposals))
        while left:
            before = self.episodes
            wave = self._wave(left, limit)
            if not wave:
                break
            trials.update(zip(wave, self._evaluate(list(wave.values())), strict=True))
            left = {place: proposal for place, proposal in left.items() if place not in wave}
            limit -= self.episodes - before
        return [trials[place] for place in sorted(trials)]

    def _wave(self, proposals: Mapping[int, Proposal], limit: int) -> dict[int, Task]:
        """Proposals whose keys all differ: what one learns, a later one of its key must know.

        A later one may be overtaken where neither the limit nor the journal can make the order matter.
        """
        overtaking = not self.replay.going and sum(each.stop - each.start for each in proposals.values()) <= limit
        wave: dict[int, Task] = {}
        keys: set[bytes] = set()
        for place, proposal in proposals.items():
            key = self._key(proposal.tree)
            if key in keys and overtaking:
                continue
            known = self._known.setdefault(key, {})
            missing = [number for number in range(proposal.start, proposal.stop) if number not in known]
            limit -= len(missing)
            if key in keys or limit < 0:
                break
            keys.add(key)
            wave[place] = Task(proposal, known, missing)
        return wave

    def _evaluate(self, wave: Sequence[Task]) -> Iterator[Trial]:
        """Side by side, as far as the executor can."""
        recorded = [self.replay.take(task.proposal, task.missing) for task in wave]
        jobs = [task for task, simulation in zip(wave, recorded, strict=True) if simulation is None and task.missing]
        fresh = self._simulator.simulate((task.proposal.tree, self._numbers(task.missing)) for task in jobs)
        for task, simulation in zip(wave, recorded, strict=True):
            self.episodes += len(task.missing)
            yield task.trial(simulation or (next(fresh) if task.missing else Simulation()))

    def _numbers(self, missing: Sequence[int]) -> Scenarios:
        return np.array(missing, dtype=np.int64) + self._first


def tree_key(domain: Domain) -> Callable[[BehaviorTree], bytes]:
    """The function whose value two trees share when the domain cannot tell them apart."""
    if domain.depends_on == "tree":
        return lambda tree: format_tree(tree).encode()
    return lambda tree: canonical_key(tree, domain.vocabulary.is_pure)
