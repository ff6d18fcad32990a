"""How fast the marine simulator is, compiled and in plain Python, on one core: `python benchmarks/marine_speed.py`."""

from __future__ import annotations

import sys
from pathlib import Path
from time import process_time
from typing import TYPE_CHECKING

import numpy as np

from grammarbt.bt import compile_policy, parse
from grammarbt_marine.domain import Marine

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.bt import Policy

sys.path.append(str(Path(__file__).parents[1] / "plugins" / "grammarbt-marine" / "tests"))

COMPILED, PLAIN = 10_000, 200
ROW = "{:<14}{:>18}{:>18}{:>18}{:>8}"


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


def main() -> None:
    """Print a table with a row per tree."""
    from marine_reference import PlainMarine  # noqa: PLC0415 - a module of the plugin's tests, findable only now

    marine = Marine()
    plain = PlainMarine(marine)
    trees = {reference.name: parse(reference.tree) for reference in marine.references}
    trees["random walk"] = parse("[random walk]")
    print("episodes per second")
    print(ROW.format("tree", "compiled, batch", "compiled, single", "plain Python", "ratio"))
    for name, tree in trees.items():
        policy = compile_policy(tree, marine.vocabulary.index)
        batch = speed(COMPILED, marine.simulate, policy, np.arange(COMPILED))
        single = speed(COMPILED, one_by_one, marine, policy)
        slow = speed(PLAIN, plain.simulate, tree, range(PLAIN))
        print(ROW.format(name, f"{batch:,.0f}", f"{single:,.0f}", f"{slow:,.0f}", f"{batch / slow:.0f}"))


if __name__ == "__main__":
    main()
