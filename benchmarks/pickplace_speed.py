"""How fast pick and place is: `python benchmarks/pickplace_speed.py [EPISODES] [TREES]`.

For each reference tree its mean return, episodes per second in batches, how many times as fast that is as plain Python,
and trees per second when each is compiled and simulated once, as a search does that meets a different tree every time.
Processor time is counted, so that what else the machine does matters little. An episode of S2 is three runs.
"""

from __future__ import annotations

import sys
from time import process_time
from typing import TYPE_CHECKING, get_args

import numpy as np

from grammarbt.bt import compile_policy, parse
from grammarbt.domain.plain import play
from grammarbt_pickplace.domain import PickPlace
from grammarbt_pickplace.parameters import PickPlaceParameters, TaskName
from grammarbt_pickplace.plain import PlainPickPlace
from grammarbt_pickplace.tasks import TASKS

if TYPE_CHECKING:
    from grammarbt.bt import BehaviorTree
    from grammarbt.domain import Reference

PLAIN_EPISODES = 100


def main(episodes: int = 20_000, trees: int = 2_000) -> None:
    """Print a row per reference tree."""
    print(f"{'task':5}{'mode':12}{'tree':14}{'return':>9}{'episodes/s':>12}{'ratio':>7}{'trees/s':>9}")
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
    begin = process_time()
    mean = domain.simulate(policy, np.arange(episodes)).returns.mean()
    batch_seconds = process_time() - begin
    begin = process_time()
    for _ in range(trees):
        domain.simulate(compile_policy(tree, index), one)
    tree_seconds = process_time() - begin
    rate = episodes / batch_seconds
    ratio = rate / _plain_rate(domain.parameters, tree)
    return f"{mean:9.2f}{rate:12,.0f}{ratio:7,.0f}{trees / tree_seconds:9,.0f}"


def _plain_rate(parameters: PickPlaceParameters, tree: BehaviorTree) -> float:
    """Episodes per second of the simulator in plain Python, drawing nothing."""
    begin = process_time()
    for scenario in range(PLAIN_EPISODES):
        for _ in play(PlainPickPlace(TASKS[parameters.task], tree, scenario, stochastic=parameters.stochastic), tree):
            pass
    return PLAIN_EPISODES / (process_time() - begin)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
