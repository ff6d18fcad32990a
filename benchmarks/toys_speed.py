"""How many episodes a second the toy worlds simulate, with their first reference tree.

python benchmarks/toys_speed.py
"""

from __future__ import annotations

import timeit
from importlib import import_module

import numpy as np

from grammarbt.bt import Policy, compile_policy, parse
from grammarbt.domain import Domain
from grammarbt_toys.hooks import grammarbt_domains

EPISODES = 1_000


def main() -> None:
    """Print a line per domain: one call per episode, as a search makes them, and all in one call."""
    print("domain           episodes/s, one a call   in one call")
    for spec in grammarbt_domains():
        module, _, name = spec.factory.partition(":")
        domain = getattr(import_module(module), name)()
        policy = compile_policy(parse(domain.references[0].tree), domain.vocabulary.index)
        rates = [_rate(domain, policy, size) for size in (1, EPISODES)]
        print(f"{spec.name:15}  {rates[0]:23,.0f}  {rates[1]:12,.0f}")


def _rate(domain: Domain, policy: Policy, size: int) -> float:
    """Episodes a second when each call simulates `size` scenarios; the best of three, after one to compile."""
    scenarios = np.arange(size)
    calls = EPISODES // size
    timer = timeit.Timer(lambda: domain.simulate(policy, scenarios))
    timer.timeit(1)
    return EPISODES / min(timer.repeat(3, calls))


if __name__ == "__main__":
    main()
