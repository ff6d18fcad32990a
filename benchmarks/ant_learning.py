"""How often does a searcher find a tree that eats all 89 pellets of the Santa Fe trail within 600 steps?

    python benchmarks/ant_learning.py --seeds 100 150 [--searcher ge --searcher "gp population=250"]

A searcher's parameters may follow its name. Each run may simulate 25,000 trees, all of it for searching. Shares come with
95 % intervals (Wilson, Journal of the American Statistical Association 1927). Seeds 0–9 are for tuning.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from math import sqrt
from pathlib import Path

import numpy as np

SEARCHERS = ("random", "uct", "ge", "gp", "qlearning view=place trace=0", "annealing", "dagmcts")
PELLETS, TRIALS, SEARCHED = 89, 25_000, 0.9
Z = 1.96


def main() -> None:
    """Print a line per searcher."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, nargs=2, default=[100, 150], metavar=("FIRST", "END"))
    parser.add_argument("--searcher", action="append", metavar="'NAME [KEY=VALUE ...]'")
    arguments = parser.parse_args()
    print("searcher                      solved  share  95 % interval  mean pellets  seconds a run")
    for searcher in arguments.searcher or SEARCHERS:
        found = [run(searcher, seed) for seed in range(*arguments.seeds)]
        solved = sum(one["value"] >= PELLETS for one in found)
        low, high = wilson(solved, len(found))
        pellets, seconds = (np.mean([one[key] for one in found]) for key in ("value", "seconds"))
        row = f"{searcher:28} {solved:3}/{len(found):<3}  {solved / len(found):5.2f}  {low:.2f} – {high:.2f}"
        print(f"{row}  {pellets:12.1f}  {seconds:13.1f}", flush=True)


def run(searcher: str, seed: int) -> dict[str, float]:
    """The JSON of one run in a process of its own."""
    name, *settings = searcher.split()
    budget = round(TRIALS / SEARCHED)  # the rest of a budget is for the final selection, which is free here
    command = [sys.executable, "-m", "grammarbt", "run", "--quiet", "--json", "--domain", "ant", "--searcher", name]
    command += ["--seed", str(seed), "--budget", str(budget), "--validation", "2", "--target", str(PELLETS)]
    command += [word for setting in settings for word in ("--set", f"searcher.{setting}")]
    with tempfile.TemporaryDirectory() as folder:
        command += ["--out", str(Path(folder) / "run")]
        found: dict[str, float] = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    return found


def wilson(solved: int, runs: int) -> tuple[float, float]:
    """95 % interval of a share."""
    share, width = solved / runs, Z * Z / runs
    middle = (share + width / 2) / (1 + width)
    half = Z * sqrt(share * (1 - share) / runs + width / (4 * runs)) / (1 + width)
    return middle - half, middle + half


if __name__ == "__main__":
    main()
