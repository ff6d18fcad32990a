"""How fast pick and place is: `python benchmarks/pickplace_speed.py [EPISODES] [TREES]`.

For each reference tree, episodes per second in batches, and trees per second when each is compiled and simulated once,
as a search does that meets a different tree every time. An episode of S2 is three runs.
"""

from __future__ import annotations

import sys
from time import perf_counter
from typing import TYPE_CHECKING, get_args

import numpy as np

from grammarbt.bt import compile_policy, parse
from grammarbt_pickplace.domain import PickPlace
from grammarbt_pickplace.parameters import PickPlaceParameters, TaskName

if TYPE_CHECKING:
    from grammarbt.domain import Reference


def main(episodes: int = 20_000, trees: int = 2_000) -> None:
    """Print a row per reference tree."""
    print(f"{'task':5}{'mode':12}{'tree':14}{'return':>9}{'episodes/s':>12}{'trees/s':>9}")
    for task in get_args(TaskName):
        for stochastic in (False, True):
            domain = PickPlace(PickPlaceParameters(task, stochastic))
            mode = "stochastic" if stochastic else "certain"
            for reference in domain.references:
                print(f"{task:5}{mode:12}{reference.name:14}{_row(domain, reference, episodes, trees)}")


def _row(domain: PickPlace, reference: Reference, episodes: int, trees: int) -> str:
    tree, index = parse(reference.tree), domain.vocabulary.index
    policy, one = compile_policy(tree, index), np.arange(1)
    domain.simulate(policy, one)  # loads the compiled code
    begin = perf_counter()
    mean = domain.simulate(policy, np.arange(episodes)).returns.mean()
    batch_seconds = perf_counter() - begin
    begin = perf_counter()
    for _ in range(trees):
        domain.simulate(compile_policy(tree, index), one)
    return f"{mean:9.2f}{episodes / batch_seconds:12,.0f}{trees / (perf_counter() - begin):9,.0f}"


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
