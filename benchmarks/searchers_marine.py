"""Every searcher on the marine default at equal budgets: mean ratio to the manual tree, and how often it was complete.

    python benchmarks/searchers_marine.py --budgets 1000 5000 --seeds 100 110 [--searcher ge --searcher gp]
    python benchmarks/searchers_marine.py --searcher "annealing episodes=1"

A searcher's parameters may follow its name. Seeds 0–9 are for tuning; claims rest on others.
"""

from __future__ import annotations

import argparse

import numpy as np
from marine_completeness import interval, run

SEARCHERS = ("random", "uct", "ge", "gp", "qlearning", "annealing", "dagmcts")


def main() -> None:
    """Print a line per searcher and budget."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--budgets", type=int, nargs="+", default=[1_000, 5_000, 20_000])
    parser.add_argument("--seeds", type=int, nargs=2, default=[100, 110], metavar=("FIRST", "END"))
    parser.add_argument("--searcher", action="append", metavar="'NAME [KEY=VALUE ...]'")
    arguments = parser.parse_args()
    print("searcher              budget  mean ratio  95 % interval  worst  complete")
    for searcher in arguments.searcher or SEARCHERS:
        for budget in arguments.budgets:
            print_row(searcher, budget, range(*arguments.seeds))


def print_row(searcher: str, budget: int, seeds: range) -> None:
    """Run every seed; one line."""
    name, *settings = searcher.split()
    options = ["--searcher", name, *(word for setting in settings for word in ("--set", f"searcher.{setting}"))]
    found = [run(seed, budget, options) for seed in seeds]
    ratios = np.array([one["ratio"] for one in found], dtype=float)
    complete = sum(bool(one["complete"]) for one in found)
    low, high = interval(ratios)
    row = f"{searcher:20} {budget:7}  {ratios.mean():10.3f}  {low:.3f} – {high:.3f}  {ratios.min():.3f}"
    print(f"{row}  {complete:4}/{len(found)}", flush=True)


if __name__ == "__main__":
    main()
