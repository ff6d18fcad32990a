"""How often is the learned marine tree complete, and how good? One row per budget.

    python benchmarks/marine_completeness.py --budgets 5000 --seeds 100 120 [--searcher compose] [--set domain.preset=sparse]

Seeds 0–9 are for tuning; claims rest on others.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

RESAMPLES = 10_000


def run(seed: int, budget: int, options: list[str]) -> dict[str, object]:
    """The JSON of one run in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "grammarbt", "run", "--quiet", "--json", "--seed", str(seed)]
        command += ["--budget", str(budget), "--out", str(Path(folder) / "run"), *options]
        result: dict[str, object] = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    return result


def interval(values: np.ndarray) -> tuple[float, float]:
    """95 % bootstrap interval of the mean."""
    rng = np.random.default_rng(0)
    means = rng.choice(values, (RESAMPLES, len(values))).mean(axis=1)
    low, high = np.quantile(means, [0.025, 0.975])
    return float(low), float(high)


def main() -> None:
    """Run every seed at every budget and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--budgets", type=int, nargs="+", default=[5000])
    parser.add_argument("--seeds", type=int, nargs=2, default=[100, 120], metavar=("FIRST", "END"))
    parser.add_argument("--searcher", default="dagmcts")
    parser.add_argument("--set", action="append", default=[], metavar="PART.KEY=VALUE")
    arguments = parser.parse_args()
    options = ["--searcher", arguments.searcher, *(word for setting in arguments.set for word in ("--set", setting))]
    print("budget  complete  mean ratio  95 % interval  worst")
    for budget in arguments.budgets:
        found = [run(seed, budget, options) for seed in range(*arguments.seeds)]
        ratios = np.array([one["ratio"] for one in found], dtype=float)
        complete = sum(bool(one["complete"]) for one in found)
        low, high = interval(ratios)
        row = f"{budget:6}  {complete:3}/{len(found):<3}  {ratios.mean():10.3f}  {low:.3f} – {high:.3f}  {ratios.min():.3f}"
        print(row, flush=True)


if __name__ == "__main__":
    main()
