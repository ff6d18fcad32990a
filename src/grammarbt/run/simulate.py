"""Calling a simulator behind a guard: what it gets wrong is data, not a crash."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from attrs import frozen

from grammarbt.bt import compile_policy
from grammarbt.domain import Outcome
from grammarbt.errors import DomainError
from grammarbt.search import EvaluationStatus

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from grammarbt.bt import BehaviorTree, Policy
    from grammarbt.domain import Domain, Scenarios

    Array: TypeAlias = NDArray[np.generic]

_NUMBERS = "fiub"
"""Kinds of arrays that hold real numbers."""

_WIDEST = 8
"""Bytes of the widest numbers that Python has too."""


@frozen
class Simulation:
    """What simulating gave.

    Attributes:
        returns: one per scenario; empty unless the status is `"ok"`.
        ticks: how often each leaf was ticked, over all episodes.
        status: `"failed"` when the simulator raised or ended its process, `"timeout"` when it took too long, `"invalid"`
            when its answer or the tree cannot be used.
        error: the reason when it is not `"ok"`.
    """

    returns: tuple[float, ...] = ()
    ticks: tuple[int, ...] = ()
    status: EvaluationStatus = "ok"
    error: str = ""


def simulate_tree(domain: Domain, tree: BehaviorTree, scenarios: Scenarios) -> Simulation:
    """Simulate one episode per scenario; a tree that the domain cannot use is invalid."""
    return simulate_trees(domain, [(tree, scenarios)])[0]


def simulate_trees(domain: Domain, jobs: Iterable[tuple[BehaviorTree, Scenarios]]) -> list[Simulation]:
    """The same for several trees, each with its scenarios.

    All are compiled first, which in a row takes less time than between episodes. Answers are read at once: the next one may
    stand in the same arrays.
    """
    policies = [(_policy(domain, tree), scenarios) for tree, scenarios in jobs]
    return [
        policy if isinstance(policy, Simulation) else simulate(domain, policy, scenarios)
        for policy, scenarios in policies
    ]


def _policy(domain: Domain, tree: BehaviorTree) -> Policy | Simulation:
    """The tree compiled, or why it cannot be."""
    try:
        return compile_policy(tree, domain.vocabulary.index)
    except DomainError as error:
        return Simulation(status="invalid", error=str(error))


def simulate(domain: Domain, policy: Policy, scenarios: Scenarios) -> Simulation:
    """Simulate one episode per scenario; whatever the simulator raises becomes the status."""
    try:
        outcome: object = domain.simulate(policy, scenarios)
    except Exception as error:  # noqa: BLE001 - a simulator is foreign code: whatever it raises is this trial's result
        return Simulation(status="failed", error=f"{type(error).__name__}: {error}")
    if not isinstance(outcome, Outcome):
        return _invalid(f"a {type(outcome).__name__} instead of an Outcome")
    returns, ticks = np.asarray(outcome.returns), np.asarray(outcome.ticks)
    fault = _fault("returns", returns, scenarios.shape) or _fault("ticks", ticks, (policy.occurrences,))
    return _invalid(fault) if fault else Simulation(tuple(returns.tolist()), tuple(ticks.tolist()))


def _invalid(what: str) -> Simulation:
    return Simulation(status="invalid", error=f"simulate gave {what}")


def _fault(name: str, array: Array, shape: tuple[int, ...]) -> str:
    """What is wrong with an array of an answer, or nothing."""
    if array.shape != shape:
        return f"{name} of shape {array.shape} instead of {shape}"
    if array.dtype.kind not in _NUMBERS or array.dtype.itemsize > _WIDEST:
        return f"{name} of type {array.dtype} instead of numbers"
    finite = array.dtype.kind != "f" or all(map(isfinite, array.tolist()))
    return "" if finite else f"{name} that are not all finite numbers"
