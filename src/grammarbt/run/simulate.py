"""Calling a simulator behind a guard: what it gets wrong is data, not a crash."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

import numpy as np
from attrs import frozen

from grammarbt.bt import compile_policy
from grammarbt.domain import Outcome
from grammarbt.errors import DomainError
from grammarbt.search import EvaluationStatus

if TYPE_CHECKING:
    from grammarbt.bt import BehaviorTree, Policy
    from grammarbt.domain import Domain, Scenarios

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
    try:
        policy = compile_policy(tree, domain.vocabulary.index)
    except DomainError as error:
        return Simulation(status="invalid", error=str(error))
    return simulate(domain, policy, scenarios)


def simulate(domain: Domain, policy: Policy, scenarios: Scenarios) -> Simulation:
    """Simulate one episode per scenario; whatever the simulator raises becomes the status."""
    try:
        outcome = domain.simulate(policy, scenarios)
    except Exception as error:  # noqa: BLE001 - a simulator is foreign code: whatever it raises is this trial's result
        return Simulation(status="failed", error=f"{type(error).__name__}: {error}")
    fault = _fault(outcome, policy, scenarios)
    if fault:
        return Simulation(status="invalid", error=fault)
    returns, ticks = tuple(outcome.returns.tolist()), tuple(outcome.ticks.tolist())
    if not all(map(isfinite, returns)):
        return Simulation(status="invalid", error="simulate gave a return that is not a finite number")
    if not all(map(isfinite, ticks)):
        return Simulation(status="invalid", error="simulate gave a number of ticks that is not finite")
    return Simulation(returns, ticks)


def _fault(outcome: object, policy: Policy, scenarios: Scenarios) -> str:
    """What is wrong with a simulator's answer, or nothing."""
    if not isinstance(outcome, Outcome):
        return f"simulate gave a {type(outcome).__name__} instead of an Outcome"
    returns, ticks = np.asarray(outcome.returns), np.asarray(outcome.ticks)
    if returns.shape != scenarios.shape:
        return f"simulate gave returns of shape {returns.shape} for {len(scenarios)} scenarios"
    if ticks.shape != (policy.occurrences,):
        return f"simulate gave ticks of shape {ticks.shape} for {policy.occurrences} leaves"
    for name, array in (("returns", returns), ("ticks", ticks)):
        if array.dtype.kind not in _NUMBERS or array.dtype.itemsize > _WIDEST:
            return f"simulate gave {name} of type {array.dtype} instead of numbers"
    return ""
