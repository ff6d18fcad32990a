"""How many episodes a second the toy worlds simulate with their first reference tree: `python benchmarks/toys_speed.py`.

Processor time is counted, so that what else the machine does matters little. Where all scenarios are alike a call
simulates one episode, whatever is asked for; so the ratio compares one episode a call with plain Python.
"""

from __future__ import annotations

import timeit
from collections import deque
from collections.abc import Callable
from time import process_time
from typing import Any, TypeAlias

import numpy as np

from grammarbt.bt import compile_policy, parse
from grammarbt.domain.plain import World, play
from grammarbt_toys.ant import Ant
from grammarbt_toys.foraging import Foraging
from grammarbt_toys.plain_ant import PlainAnt
from grammarbt_toys.plain_foraging import PlainForaging
from grammarbt_toys.plain_platformer import PlainGame, draw_level
from grammarbt_toys.plain_taskselection import PlainTaskSelection
from grammarbt_toys.platformer import Platformer
from grammarbt_toys.taskselection import TaskSelection
from grammarbt_toys.trail import santa_fe_rows

Toy: TypeAlias = Ant | Foraging | Platformer | TaskSelection

EPISODES = 1_000
PLAIN_EPISODES = 20

PLAIN: dict[type[Toy], Callable[[Any, int], World]] = {
    TaskSelection: lambda parameters, _: PlainTaskSelection(parameters.conditions),
    Ant: lambda parameters, _: PlainAnt(santa_fe_rows(), parameters.steps),
    Foraging: PlainForaging,
    Platformer: lambda parameters, number: PlainGame(draw_level(number, parameters.columns), parameters.steps),
}
"""By domain the start of an episode in plain Python."""


def main() -> None:
    """Print a line per domain: one call per episode, as a search makes them, all in one call, and in plain Python."""
    print(f"{'domain':15}{'return':>8}{'one a call':>12}{'in one call':>13}{'plain':>8}{'ratio':>7}")
    for toy, begin in PLAIN.items():
        print(f"{toy.__name__:15}{_row(toy(), begin)}")


def _row(domain: Toy, begin: Callable[[Any, int], World]) -> str:
    tree = parse(domain.references[0].tree)
    policy = compile_policy(tree, domain.vocabulary.index)

    def compiled(size: int) -> float:
        return size * _rate(lambda: domain.simulate(policy, np.arange(size)), EPISODES // size)

    def played() -> None:
        for number in range(PLAIN_EPISODES):
            deque(play(begin(domain.parameters, number), tree), maxlen=0)

    mean = domain.simulate(policy, np.arange(EPISODES)).returns.mean()
    one, many, plain = compiled(1), compiled(EPISODES), PLAIN_EPISODES * _rate(played, 1)
    return f"{mean:8.2f}{one:12,.0f}{many:13,.0f}{plain:8,.0f}{one / plain:7,.0f}"


def _rate(call: Callable[[], object], calls: int) -> float:
    """Calls a second, the best of three."""
    return calls / min(timeit.repeat(call, timer=process_time, repeat=3, number=calls))


if __name__ == "__main__":
    main()
