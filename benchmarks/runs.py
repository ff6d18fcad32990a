"""Kill runs with SIGKILL at random moments, resume them, and compare journals byte by byte.

python benchmarks/runs.py --kills 50 --searcher dagmcts --searcher random
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

COMMAND = (sys.executable, "-m", "grammarbt")


def main() -> int:
    """Print, for each searcher, how many killed runs ended with the journal of the uninterrupted one."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--searcher", action="append", default=[])
    parser.add_argument("--domain", default="marine")
    parser.add_argument("--budget", default="5000")
    parser.add_argument("--workers", default="1", help="more than 1: with the processes executor")
    options = parser.parse_args()
    pool = () if options.workers == "1" else ("--executor", "processes", "--workers", options.workers)
    shared = ("--domain", options.domain, "--budget", options.budget, "--batch", "8", "--validation", "20", *pool)
    same = [_report(searcher, shared, options.kills) for searcher in options.searcher or ["dagmcts", "random"]]
    return 0 if all(same) else 1


def _report(searcher: str, shared: tuple[str, ...], kills: int) -> bool:
    started = time.monotonic()
    with tempfile.TemporaryDirectory() as scratch:
        arguments = ("run", "--quiet", "--searcher", searcher, *shared, "--out")
        whole = Path(scratch) / "whole"
        _finish(*arguments, str(whole))
        expected = _journal(whole)
        chance = np.random.default_rng(0)
        sizes = [int(size) for size in chance.integers(len(expected), size=kills)]
        found = [_survives(Path(scratch) / str(at), arguments, size, expected) for at, size in enumerate(sizes)]
    cut = [part for part, _ in found]
    same = sum(equal for _, equal in found)
    print(
        f"{searcher}: {same} of {kills} resumed runs end with the same {len(expected):,} bytes; "
        f"killed at {min(cut):,} to {max(cut):,} bytes; {time.monotonic() - started:.0f} s"
    )
    return same == kills


def _survives(folder: Path, arguments: tuple[str, ...], size: int, expected: bytes) -> tuple[int, bool]:
    """How long the journal was after the kill, and whether the resumed one is as expected."""
    journal = folder / "journal.jsonl"
    with subprocess.Popen([*COMMAND, *arguments, str(folder)], stdout=subprocess.DEVNULL) as process:
        while process.poll() is None and not (journal.exists() and journal.stat().st_size >= size):
            time.sleep(0.0005)
        process.kill()
    cut = journal.stat().st_size
    _finish("resume", "--quiet", str(folder))
    return cut, _journal(folder) == expected


def _finish(*arguments: str) -> None:
    subprocess.run([*COMMAND, *arguments], check=True, stdout=subprocess.DEVNULL)


def _journal(folder: Path) -> bytes:
    return (folder / "journal.jsonl").read_bytes()


if __name__ == "__main__":
    sys.exit(main())
