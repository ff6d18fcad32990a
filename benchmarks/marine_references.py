"""What the reference trees of the marine presets and teams earn: `python benchmarks/marine_references.py`.

Means over the episodes of run seed 100, with their standard errors; the last column is without the tree's sub-tree that
minds the battery, where it has one.
"""

from __future__ import annotations

import argparse

import numpy as np

from grammarbt.bt import BehaviorTree, Fallback, compile_policy, format_tree, parse
from grammarbt.domain import scenario_numbers
from grammarbt_marine.domain import Marine
from grammarbt_marine.parameters import MarineParameters
from grammarbt_marine.presets import PRESETS

ROW = "{:<9}{:>7}{:>9}  {:<12}{:>18}{:>18}"
SEED = 100


def mean(marine: Marine, tree: BehaviorTree, episodes: int) -> str:
    """Mean return and its standard error."""
    policy = compile_policy(tree, marine.vocabulary.index)
    returns = marine.simulate(policy, scenario_numbers(SEED, 0, episodes)).returns
    return f"{returns.mean():.2f} ± {returns.std(ddof=1) / np.sqrt(episodes):.2f}"


def unguarded(tree: BehaviorTree) -> BehaviorTree | None:
    """The tree without the sub-tree that asks for the battery."""
    if not isinstance(tree, Fallback):
        return None
    rest = tuple(child for child in tree.children if "battery low" not in format_tree(child))
    return Fallback(rest) if len(rest) < len(tree.children) else None


def main() -> None:
    """Print a row per preset, size of the team, horizon and reference tree."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--episodes", type=int, default=20_000)
    parser.add_argument("--robots", type=int, nargs="+", default=[1, 2, 3])
    arguments = parser.parse_args()
    print(ROW.format("preset", "robots", "horizon", "tree", "mean return", "no battery guard"))
    for preset in PRESETS:
        for robots in arguments.robots:
            for shorter in (1, 2):
                horizon = MarineParameters(preset).horizon // shorter
                marine = Marine(MarineParameters(preset, robots=robots, horizon=horizon))
                for reference in marine.references:
                    tree = parse(reference.tree)
                    rest = unguarded(tree)
                    without = mean(marine, rest, arguments.episodes) if rest else ""
                    row = (preset, robots, horizon, reference.name, mean(marine, tree, arguments.episodes), without)
                    print(ROW.format(*row), flush=True)


if __name__ == "__main__":
    main()
