"""Evaluating proposals: known returns are looked up, only the missing episodes are simulated."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from attrs import frozen

from grammarbt.bt import BehaviorTree, Condition, compile_policy, format_tree
from grammarbt.bt.canonical import canonical_key
from grammarbt.domain import ConditionType, Domain, scenario_numbers
from grammarbt.errors import DomainError
from grammarbt.run.simulate import Simulation, simulate
from grammarbt.search import Evaluation, Proposal

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from grammarbt.domain import Scenarios


@frozen
class Trial:
    """An evaluation, and how many of its episodes had to be simulated."""

    evaluation: Evaluation
    simulated: int


class Evaluator:
    """Scores trees on a domain and remembers every return.

    Args:
        domain: the simulator.
        seed: the run's seed; with a scenario's number it fixes the world.

    Attributes:
        episodes: episodes simulated so far.
    """

    def __init__(self, domain: Domain, seed: int) -> None:
        self.episodes = 0
        self._domain = domain
        self._index = domain.vocabulary.index
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
        trials = []
        for proposal in proposals:
            known = self._known.setdefault(self._key(proposal.tree), {})
            missing = [number for number in range(proposal.start, proposal.stop) if number not in known]
            if len(missing) > limit:
                break
            limit -= len(missing)
            trials.append(Trial(self._evaluate(proposal, known, missing), len(missing)))
        return trials

    def _evaluate(self, proposal: Proposal, known: dict[int, float], missing: list[int]) -> Evaluation:
        simulation = self._simulate(proposal.tree, np.array(missing, dtype=np.int64)) if missing else Simulation()
        if simulation.status != "ok":
            return Evaluation(proposal, (), (), simulation.status, simulation.error)
        known.update(zip(missing, simulation.returns, strict=True))
        returns = tuple(known[number] for number in range(proposal.start, proposal.stop))
        return Evaluation(proposal, returns, simulation.ticks)

    def _simulate(self, tree: BehaviorTree, numbers: Scenarios) -> Simulation:
        self.episodes += len(numbers)
        try:
            policy = compile_policy(tree, self._index)
        except DomainError as error:
            return Simulation(status="invalid", error=str(error))
        return simulate(self._domain, policy, numbers + self._first)


def tree_key(domain: Domain) -> Callable[[BehaviorTree], bytes]:
    """The function whose value two trees share when the domain cannot tell them apart."""
    if domain.depends_on == "tree":
        return lambda tree: format_tree(tree).encode()
    types = domain.vocabulary.types

    def is_pure(condition: Condition) -> bool:
        declared = types.get(condition)
        return isinstance(declared, ConditionType) and declared.pure

    return lambda tree: canonical_key(tree, is_pure)
