"""How good a tree is learned in pick and place? One row per task, searcher and number of distinct trees simulated.

    python benchmarks/pickplace_learning.py --tasks S1 S2 --searchers dagmcts gp --trees 1000 10000 --seeds 100 110
    python benchmarks/pickplace_learning.py --grammar pickplace-published

Each run simulates the largest number of trees; what it had found after fewer is read from its journal: the highest mean
return that a tree had. The last row tells what the final tree is worth in fresh scenarios. The published curve is that
of genetic programming (Iovino et al., ICRA 2021) in the space of `pickplace-published`; it counts distinct trees too.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

PUBLISHED: dict[str, dict[int, float]] = {
    "S1": {1_000: -787, 5_000: -713, 10_000: -604, 20_000: -382, 50_000: -66, 100_000: -15.8},
    "S2": {1_000: -1014, 5_000: -984, 10_000: -939, 20_000: -839, 50_000: -428, 100_000: -231},
    "S3": {1_000: -5938, 5_000: -5611, 10_000: -5459, 20_000: -4761, 50_000: -3077, 100_000: -1925},
}


def run(task: str, searcher: str, grammar: str, trees: list[int], seed: int) -> list[float]:
    """The best return after each number of trees, and at last the final tree's in fresh scenarios."""
    with tempfile.TemporaryDirectory() as folder:
        spec, out = Path(folder) / "spec.toml", Path(folder) / "run"
        spec.write_text(
            f'domain = "pickplace"\nsearcher = "{searcher}"\ngrammar = "{grammar}"\nseed = {seed}\n'
            f'budget = {max(trees)}\nselection = 0\nvalidation = 200\n[set.domain]\ntask = "{task}"\n'
        )
        command = [sys.executable, "-m", "grammarbt", "run", str(spec), "--quiet", "--json", "--out", str(out)]
        told = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
        return [*curve((out / "journal.jsonl").read_text(encoding="utf-8"), trees), float(told["value"])]


def curve(journal: str, trees: list[int]) -> list[float]:
    """The highest mean return that one of the first so many distinct trees had when it was first simulated."""
    means: dict[str, float] = {}
    for event in map(json.loads, journal.splitlines()):
        if event["event"] == "trial" and event["returns"]:
            means.setdefault(event["tree"], statistics.mean(event["returns"]))
    return [max(list(means.values())[:number]) for number in trees]


def main() -> None:
    """Run everything and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tasks", nargs="+", default=["S1"], choices=PUBLISHED)
    parser.add_argument("--searchers", nargs="+", default=["dagmcts"])
    parser.add_argument("--grammar", default="pickplace")
    parser.add_argument("--trees", type=int, nargs="+", default=[1_000, 5_000, 10_000])
    parser.add_argument("--seeds", type=int, nargs=2, default=[100, 110], metavar=("FIRST", "END"))
    given = parser.parse_args()
    print("task  searcher  trees      mean    median     worst      best  published")
    for task in given.tasks:
        for searcher in given.searchers:
            found = [run(task, searcher, given.grammar, given.trees, seed) for seed in range(*given.seeds)]
            *steps, final = zip(*found, strict=True)
            for number, values in zip(given.trees, steps, strict=True):
                print(f"{task:4}  {searcher:8}  {number:5}  {row(values)}  {PUBLISHED[task].get(number, '')}")
            print(f"{task:4}  {searcher:8}  final  {row(final)}", flush=True)


def row(values: tuple[float, ...]) -> str:
    """Mean, median, worst and best."""
    figures = (statistics.mean(values), statistics.median(values), min(values), max(values))
    return "  ".join(f"{value:8.1f}" for value in figures)


if __name__ == "__main__":
    main()
