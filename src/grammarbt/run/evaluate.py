"""Evaluating proposals: known returns are looked up, only the missing episodes are simulated."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from attrs import define, frozen

from grammarbt.bt import BehaviorTree, format_tree
from grammarbt.bt.fingerprint import Fingerprints, text_fingerprint
from grammarbt.domain import Domain, scenario_numbers
from grammarbt.run.cache import Known, ReturnCache
from grammarbt.run.replay import Replay
from grammarbt.run.simulate import Simulation
from grammarbt.run.simulator import SerialSimulator, Simulator
from grammarbt.search import Evaluation, Proposal

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.domain import Scenarios

_NOTHING, _UNKNOWN = Simulation(), Known()
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


@define(eq=False)
class Task:
    """A proposal on its way to a trial.

    Attributes:
        proposal: what was asked for.
        text: its tree in the one-line notation.
        key: under which the tree's returns are known.
        known: these returns, once looked up.
        missing: the scenarios whose returns are not known.
        simulation: of these, if the journal has it.
        trial: the end, once there is one.
    """

    proposal: Proposal
    text: str
    key: bytes
    known: Known = _UNKNOWN
    missing: Sequence[int] = ()
    simulation: Simulation | None = None
    trial: Trial | None = None

    def look_up(self, known: Known) -> None:
        """Find what is missing."""
        self.known = known
        numbers = range(self.proposal.start, self.proposal.stop)
        self.missing = [number for number in numbers if number not in known.returns] if known.returns else numbers

    def finish(self, simulation: Simulation) -> None:
        """Note the returns, now that the missing scenarios are simulated."""
        proposal, known = self.proposal, self.known
        if simulation.status != "ok":
            failed = Evaluation(proposal, (), (), simulation.status, simulation.error)
            self.trial = Trial(failed, self.text, len(self.missing))
            return
        returns = fresh = simulation.returns
        known.learn(self.missing, fresh)
        if len(fresh) < proposal.stop - proposal.start:
            returns = tuple([known.returns[number] for number in range(proposal.start, proposal.stop)])
        evaluation = Evaluation(proposal, returns, simulation.ticks)
        self.trial = Trial(evaluation, self.text, len(fresh), fresh, known.mean, len(known.returns))


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
        self._fingerprint = tree_fingerprint(domain)
        self._keys: dict[str, bytes] = {}

    def key(self, tree: BehaviorTree) -> bytes:
        """Equal for trees that always have the same return."""
        return self._key(tree, format_tree(tree))

    def evaluate(self, proposals: Sequence[Proposal], limit: int) -> list[Trial]:
        """Evaluate proposals in order until the next would simulate more than `limit` episodes in all."""
        texts = [format_tree(proposal.tree) for proposal in proposals]
        tasks = [Task(each, text, self._key(each.tree, text)) for each, text in zip(proposals, texts, strict=True)]
        used: dict[bytes, Known] = {}
        left, end = tasks, self.episodes + limit
        while left and (wave := self._wave(left, used, end - self.episodes)):
            self._finish(wave)
            left = [task for task in left if task.trial is None]
        trials = [task.trial for task in tasks if task.trial is not None]
        self.cache.keep(used, sum([len(trial.fresh) for trial in trials]))
        return trials

    def _key(self, tree: BehaviorTree, text: str) -> bytes:
        key = self._keys.get(text)
        if key is None:
            if len(self._keys) >= _RECENT:
                self._keys.clear()
            key = self._keys[text] = self._fingerprint(tree, text)
        return key

    def _wave(self, left: Sequence[Task], used: dict[bytes, Known], limit: int) -> list[Task]:
        """Tasks whose keys all differ: what one learns, a later one of its key must know."""
        wave: list[Task] = []
        keys: set[bytes] = set()
        spare = limit
        for task in left:
            if task.key in keys:
                if self._in_order(left, limit):
                    break
                continue
            known = used.get(task.key)
            if known is None:
                known = used[task.key] = self.cache.get(task.key)
            task.look_up(known)
            spare -= len(task.missing)
            if spare < 0:
                break
            keys.add(task.key)
            wave.append(task)
        return wave

    def _in_order(self, left: Sequence[Task], limit: int) -> bool:
        """Whether no task may be overtaken: the limit may end the batch before it, or the journal expects it."""
        return self.replay.going or sum(task.proposal.stop - task.proposal.start for task in left) > limit

    def _finish(self, wave: Sequence[Task]) -> None:
        """Side by side, as far as the executor can."""
        if self.replay.going:
            for task in wave:
                task.simulation = self.replay.take(task.proposal, task.text, task.missing)
        jobs = [task for task in wave if task.simulation is None and task.missing]
        simulations = self._simulator.simulate([(task.proposal.tree, self._numbers(task.missing)) for task in jobs])
        fresh = iter([*simulations])  # all first: what is done in a row still finds the processor's caches warm
        for task in wave:
            self.episodes += len(task.missing)
            task.finish(task.simulation or (next(fresh) if task.missing else _NOTHING))

    def _numbers(self, missing: Sequence[int]) -> Scenarios:
        if isinstance(missing, range):  # nearly always, and twice as fast
            return np.arange(self._first + missing.start, self._first + missing.stop, dtype=np.int64)
        return np.array([self._first + number for number in missing], dtype=np.int64)


def tree_fingerprint(domain: Domain) -> Callable[[BehaviorTree, str], bytes]:
    """The function of a tree and its text whose value trees share when the domain cannot tell them apart."""
    if domain.depends_on == "tree":
        return lambda _, text: text_fingerprint(text)
    fingerprint = Fingerprints(domain.vocabulary.pure.__contains__)
    return lambda tree, _: fingerprint(tree)
