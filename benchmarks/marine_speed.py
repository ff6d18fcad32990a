"""How fast the marine simulator is, compiled and in plain Python, on one core: `python benchmarks/marine_speed.py`."""

from __future__ import annotations

from time import process_time
from typing import TYPE_CHECKING

import numpy as np

from grammarbt.bt import compile_policy, parse
from grammarbt_marine.domain import Marine
from grammarbt_marine.parameters import MarineParameters
from grammarbt_marine.plain import PlainMarine

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.bt import Policy

COMPILED, PLAIN = 10_000, 200
WORLDS = {
    "default": MarineParameters(),
    "sparse": MarineParameters("sparse"),
    "scheide": MarineParameters("scheide"),
    "default, 2 robots": MarineParameters(robots=2),
}
ROW = "{:<19}{:<14}{:>18}{:>18}{:>18}{:>8}"


def speed(episodes: int, simulate: Callable[..., object], *arguments: object) -> float:
    """Episodes per second of processor time, in the second call; the first one compiles and fills caches."""
    simulate(*arguments)
    start = process_time()
    simulate(*arguments)
    return episodes / (process_time() - start)


def one_by_one(marine: Marine, policy: Policy) -> None:
    """A call per episode, as when a searcher asks for single episodes."""
    for scenario in range(COMPILED):
        marine.simulate(policy, np.array([scenario]))


def print_rows(world: str, parameters: MarineParameters) -> None:
    """Print a row per tree."""
    marine = Marine(parameters)
    plain = PlainMarine(marine)
    trees = {reference.name: parse(reference.tree) for reference in marine.references}
    trees["random walk"] = parse("[random walk]")
    for name, tree in trees.items():
        policy = compile_policy(tree, marine.vocabulary.index)
        batch = speed(COMPILED, marine.simulate, policy, np.arange(COMPILED))
        single = speed(COMPILED, one_by_one, marine, policy)
        slow = speed(PLAIN, plain.simulate, tree, range(PLAIN))
        print(ROW.format(world, name, f"{batch:,.0f}", f"{single:,.0f}", f"{slow:,.0f}", f"{batch / slow:.0f}"))


def main() -> None:
    """Print a table of episodes per second."""
    print(ROW.format("world", "tree", "compiled, batch", "compiled, single", "plain Python", "ratio"))
    for world, parameters in WORLDS.items():
        print_rows(world, parameters)


if __name__ == "__main__":
    main()
