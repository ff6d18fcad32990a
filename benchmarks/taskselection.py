"""Episodes until task selection is solved exactly, by number of conditions and searcher.

    python benchmarks/taskselection.py --conditions 3 4 5 --searchers dagmcts compose --seeds 100 110 --budget 50000

The budget has no final selection: the first tree that is right in every assignment ends the run.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

SOLVED = 1.0


def run(searcher: str, conditions: int, seed: int, budget: int) -> dict[str, object]:
    """The JSON of one run in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        spec = Path(folder) / "spec.toml"
        spec.write_text(
            f'domain = "taskselection"\nsearcher = "{searcher}"\nseed = {seed}\nbudget = {budget}\nselection = 0\n'
            f"target = {SOLVED}\nvalidation = 2\n[set.domain]\nconditions = {conditions}\n"
        )
        command = [sys.executable, "-m", "grammarbt", "run", str(spec), "--quiet", "--json"]
        command += ["--out", str(Path(folder) / "run")]
        result: dict[str, object] = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    return result


def main() -> None:
    """Run every searcher on every size and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--conditions", type=int, nargs="+", default=[3, 4, 5])
    parser.add_argument("--searchers", nargs="+", default=["dagmcts", "compose"])
    parser.add_argument("--seeds", type=int, nargs=2, default=[100, 110], metavar=("FIRST", "END"))
    parser.add_argument("--budget", type=int, default=50_000)
    arguments = parser.parse_args()
    print("N  searcher  solved  median episodes  most")
    for conditions in arguments.conditions:
        for searcher in arguments.searchers:
            found = [run(searcher, conditions, seed, arguments.budget) for seed in range(*arguments.seeds)]
            solved = [int(str(one["episodes"])) for one in found if one["stopped"] == "target"]
            shown = f"{statistics.median(solved):15.0f}  {max(solved)}" if solved else ""
            print(f"{conditions}  {searcher:8}  {len(solved):2}/{len(found):<3}  {shown}", flush=True)


if __name__ == "__main__":
    main()
