"""How good a tree is learned in pick and place? One row per task, searcher and budget of simulated trees.

    python benchmarks/pickplace_learning.py --tasks S1 S2 --searchers dagmcts gp --budgets 10000 --seeds 100 110

Where one episode tells a tree's worth the searchers simulate no tree twice, so that episodes are distinct trees. Values
are means of the best tree over fresh scenarios, beside the published curve of genetic programming (Iovino et al., ICRA
2021), which counts distinct trees too.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

PUBLISHED = {
    "S1": {1_000: -787, 5_000: -713, 10_000: -604, 20_000: -382, 50_000: -66, 100_000: -15.8},
    "S2": {1_000: -1014, 5_000: -984, 10_000: -939, 20_000: -839, 50_000: -428, 100_000: -231},
    "S3": {1_000: -5938, 5_000: -5611, 10_000: -5459, 20_000: -4761, 50_000: -3077, 100_000: -1925},
}


def run(task: str, searcher: str, budget: int, seed: int, options: list[str]) -> float:
    """The learned tree's mean return on fresh scenarios."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "grammarbt", "run", "--quiet", "--json", "--domain", "pickplace"]
        command += ["--set", f"domain.task={task}", "--searcher", searcher, "--budget", str(budget)]
        command += ["--seed", str(seed), "--out", str(Path(folder) / "run"), *options]
        return float(json.loads(subprocess.run(command, check=True, capture_output=True).stdout)["value"])


def main() -> None:
    """Run everything and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tasks", nargs="+", default=["S1"], choices=PUBLISHED)
    parser.add_argument("--searchers", nargs="+", default=["dagmcts"])
    parser.add_argument("--budgets", type=int, nargs="+", default=[10_000])
    parser.add_argument("--seeds", type=int, nargs=2, default=[100, 110], metavar=("FIRST", "END"))
    parser.add_argument("--set", action="append", default=[], metavar="PART.KEY=VALUE")
    arguments = parser.parse_args()
    options = [word for setting in arguments.set for word in ("--set", setting)]
    print("task  searcher   budget      mean    median     worst      best  published")
    for task in arguments.tasks:
        for searcher in arguments.searchers:
            for budget in arguments.budgets:
                values = [run(task, searcher, budget, seed, options) for seed in range(*arguments.seeds)]
                row = (statistics.mean(values), statistics.median(values), min(values), max(values))
                figures = "  ".join(f"{value:8.1f}" for value in row)
                print(f"{task:4}  {searcher:8}  {budget:7}  {figures}  {PUBLISHED[task].get(budget, '')}", flush=True)


if __name__ == "__main__":
    main()
