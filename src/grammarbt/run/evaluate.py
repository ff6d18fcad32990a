"""Evaluating proposals: known returns are looked up, only the missing episodes are simulated."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache, partial
from hashlib import blake2b
from typing import TYPE_CHECKING

import numpy as np
from attrs import frozen

from grammarbt.bt import BehaviorTree, format_tree
from grammarbt.bt.canonical import canonical_key
from grammarbt.domain import Domain, scenario_numbers
from grammarbt.run.cache import Known, ReturnCache
from grammarbt.run.replay import Replay
from grammarbt.run.simulate import Simulation
from grammarbt.run.simulator import SerialSimulator, Simulator
from grammarbt.search import Evaluation, Proposal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping

    from grammarbt.domain import Scenarios

_DIGEST = 16
"""Bytes of a key; two different trees among 10^12 share one with a probability below 10^-14."""


_RECENT = 1_024
"""Trees whose keys are kept: a race asks for the same trees again and again."""


@frozen
class Trial:
    """An evaluation.

    Attributes:
        evaluation: what the searcher is told.
        text: the tree in the one-line notation.
        simulated: how many of its episodes had to be simulated.
        fresh: the returns of these; empty unless the status is `"ok"`.
        mean: of all returns that are known of the tree by now.
        episodes: how many these are.
    """

    evaluation: Evaluation
    text: str
    simulated: int
    fresh: tuple[float, ...] = ()
    mean: float = float("-inf")
    episodes: int = 0


@frozen(eq=False)
class Asked:
    """A proposal, its tree in the one-line notation, and the key under which its returns are known."""

    proposal: Proposal
    text: str
    key: bytes


@frozen(eq=False)
class Task:
    """What was asked for, the returns known of its tree, and the scenarios whose returns are missing."""

    asked: Asked
    known: Known
    missing: Sequence[int]

    def trial(self, simulation: Simulation) -> Trial:
        """The trial, now that the missing scenarios are simulated; notes their returns."""
        proposal, text, known = self.asked.proposal, self.asked.text, self.known
        if simulation.status != "ok":
            failed = Evaluation(proposal, (), (), simulation.status, simulation.error)
            return Trial(failed, text, len(self.missing))
        fresh = simulation.returns
        known.learn(self.missing, fresh)
        returns = tuple([known.returns[number] for number in range(proposal.start, proposal.stop)])
        evaluation = Evaluation(proposal, returns, simulation.ticks)
        return Trial(evaluation, text, len(fresh), fresh, known.mean, len(known.returns))


class Evaluator:
    """Scores trees on a domain and remembers their returns.

    Args:
        domain: the simulator.
        seed: the run's seed; with a scenario's number it fixes the world.
        replay: answers the first proposals instead of the simulator, when the run goes on from a journal.
        simulator: simulates; one after the other unless given.
        cache: remembers returns.

    Attributes:
        episodes: episodes simulated so far, those of the journal included.
        replay: as given.
        cache: as given.
    """

    def __init__(
        self,
        domain: Domain,
        seed: int,
        replay: Replay | None = None,
        simulator: Simulator | None = None,
        cache: ReturnCache | None = None,
    ) -> None:
        self.episodes = 0
        self.replay = Replay() if replay is None else replay
        self.cache = ReturnCache() if cache is None else cache
        self._simulator = simulator or SerialSimulator(domain)
        self._first = int(scenario_numbers(seed, 0, 1)[0])
        self._identity = lru_cache(_RECENT)(partial(_identity, tree_key(domain)))

    def key(self, tree: BehaviorTree) -> bytes:
        """Equal for trees that always have the same return."""
        return self._identity(tree)[1]

    def evaluate(self, proposals: Sequence[Proposal], limit: int) -> list[Trial]:
        """Evaluate proposals in order until the next would simulate more than `limit` episodes in all."""
        trials: dict[int, Trial] = {}
        used: dict[bytes, Known] = {}
        left = {place: self._asked(proposal) for place, proposal in enumerate(proposals)}
        before = self.episodes
        while left and (wave := self._wave(left, used, limit + before - self.episodes)):
            trials.update(zip(wave, self._evaluate(list(wave.values())), strict=True))
            left = {place: asked for place, asked in left.items() if place not in wave}
        self._remember(used, trials.values())
        return [trials[place] for place in sorted(trials)]

    def _asked(self, proposal: Proposal) -> Asked:
        return Asked(proposal, *self._identity(proposal.tree))

    def _wave(self, left: Mapping[int, Asked], used: dict[bytes, Known], limit: int) -> dict[int, Task]:
        """Proposals whose keys all differ: what one learns, a later one of its key must know.

        A later one may be overtaken where neither the limit nor the journal can make the order matter.
        """
        wanted = sum(asked.proposal.stop - asked.proposal.start for asked in left.values())
        overtaking = wanted <= limit and not self.replay.going
        wave: dict[int, Task] = {}
        keys: set[bytes] = set()
        for place, asked in left.items():
            key = asked.key
            if key in keys and overtaking:
                continue
            task = self._task(asked, used)
            limit -= len(task.missing)
            if key in keys or limit < 0:
                break
            keys.add(key)
            wave[place] = task
        return wave

    def _task(self, asked: Asked, used: dict[bytes, Known]) -> Task:
        known = used.get(asked.key)
        if known is None:
            known = used[asked.key] = self.cache.get(asked.key)
        numbers = range(asked.proposal.start, asked.proposal.stop)
        return Task(asked, known, [number for number in numbers if number not in known.returns])

    def _evaluate(self, wave: Sequence[Task]) -> Iterator[Trial]:
        """Side by side, as far as the executor can."""
        recorded = [self.replay.take(task.asked.proposal, task.asked.text, task.missing) for task in wave]
        jobs = [task for task, simulation in zip(wave, recorded, strict=True) if simulation is None and task.missing]
        fresh = self._simulator.simulate((task.asked.proposal.tree, self._numbers(task.missing)) for task in jobs)
        for task, simulation in zip(wave, recorded, strict=True):
            self.episodes += len(task.missing)
            yield task.trial(simulation or (next(fresh) if task.missing else Simulation()))

    def _remember(self, used: Mapping[bytes, Known], trials: Iterable[Trial]) -> None:
        self.cache.keep(used, sum([len(trial.fresh) for trial in trials]))

    def _numbers(self, missing: Sequence[int]) -> Scenarios:
        return np.array(missing, dtype=np.int64) + self._first


def _identity(key: Callable[[BehaviorTree, str], bytes], tree: BehaviorTree) -> tuple[str, bytes]:
    """A tree in the one-line notation, and the key under which its returns are known."""
    text = format_tree(tree)
    return text, blake2b(key(tree, text), digest_size=_DIGEST).digest()


def tree_key(domain: Domain) -> Callable[[BehaviorTree, str], bytes]:
    """The function of a tree and its text whose value trees share when the domain cannot tell them apart."""
    if domain.depends_on == "tree":
        return lambda _, text: text.encode()
    return lambda tree, _: canonical_key(tree, domain.vocabulary.is_pure)
