"""Inject every fault into 1 % of the simulations of a run, and check that its counts add up and nothing is lost.

python benchmarks/faults.py --episodes 20000
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from grammarbt.run.journal import Event, read_journal

FAULTY = f"{Path(__file__).parents[1] / 'tests' / 'run' / 'faulty.py'}:Faulty"
FAULTS = {
    "raises": ("failed", "is broken"),
    "nan": ("invalid", "finite"),
    "shape": ("invalid", "shape"),
    "hangs": ("timeout", "longer than"),
    "exits": ("failed", "exit code 3"),
    "crashes": ("failed", "exit code -11"),
    "swells": ("failed", "MB of memory"),
}
"""What each fault makes of a trial, and what its reason says."""


def main() -> int:
    """Print how often each fault struck, and whether everything is accounted for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--episodes", type=int, default=20_000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--every", type=int, default=101, help="a fault strikes every so many simulations")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        started = time.monotonic()
        result = _run(Path(scratch) / "run", options.episodes, options.workers, options.every)
        events = read_journal(Path(scratch) / "run" / "journal.jsonl")
    trials = [event for event in events if event["event"] == "trial"]
    print(f"{len(trials):,} trials, {result['episodes']:,} episodes, {time.monotonic() - started:.0f} s")
    struck = Counter(_fault(str(event["status"]), str(event["error"])) for event in trials if event["status"] != "ok")
    for fault in FAULTS:
        print(f"{fault:8}  {struck[fault]:6,} trials  {struck[fault] / len(trials):.2%}")
    checks = {
        "every fault struck": set(struck) == set(FAULTS),
        "the episodes of the journal are those reported": _episodes(events) == result["episodes"],
        "no more than the budget was spent": _episodes(events) <= options.episodes,
        "the trials of the journal are those reported": len(trials) == result["trials"],
        "the failures of the journal are those reported": _failed(trials) == result["failed"],
        "every good trial has all its returns": all(map(_complete, trials)),
    }
    for check, holds in checks.items():
        print(f"{'yes' if holds else 'NO ':3} {check}")
    return 0 if all(checks.values()) else 1


def _run(folder: Path, episodes: int, workers: int, every: int) -> dict[str, object]:
    settings = [f"domain.{fault}={every + 2 * number}" for number, fault in enumerate(FAULTS)]
    settings += ["executor.timeout=0.5", "executor.memory=260"]
    arguments = [word for setting in settings for word in ("--set", setting)]
    command = [
        sys.executable,
        "-m",
        "grammarbt",
        "run",
        "--domain",
        FAULTY,
        "--searcher",
        "random",
        "--json",
        "--quiet",
    ]
    sizes = ["--budget", str(episodes), "--batch", "64", "--workers", str(workers), "--validation", "20"]
    done = subprocess.run(
        [*command, *sizes, *arguments, "--out", str(folder)], check=True, stdout=subprocess.PIPE, text=True
    )
    result: dict[str, object] = json.loads(done.stdout)
    return result


def _fault(status: str, error: str) -> str:
    """Which fault it was."""
    return next((fault for fault, (kind, text) in FAULTS.items() if kind == status and text in error), error)


def _episodes(events: list[Event]) -> int:
    return sum(int(str(event["simulated"])) for event in events if "simulated" in event)


def _failed(trials: list[Event]) -> dict[str, int]:
    return dict(Counter(str(event["status"]) for event in trials if event["status"] != "ok"))


def _complete(event: Event) -> bool:
    returns, start, stop = event["returns"], event["start"], event["stop"]
    good = event["status"] == "ok"
    return isinstance(returns, list) and len(returns) == (int(str(stop)) - int(str(start)) if good else 0)


if __name__ == "__main__":
    sys.exit(main())
