"""Kill runs with SIGKILL at random moments, resume them, and compare journals byte by byte.

python benchmarks/resume_kills.py --kills 50 --searcher dagmcts --searcher random
"""

from __future__ import annotations

import argparse
import contextlib
import io
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from grammarbt.cli import main as grammarbt
from grammarbt.cli.failures import SUCCESS

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
    searchers = options.searcher or ["dagmcts", "random"]
    print("searcher  workers  same bytes  killed at           of bytes  seconds")
    same = [_report(searcher, options.workers, shared, options.kills) for searcher in searchers]
    return 0 if all(same) else 1


def _report(searcher: str, workers: str, shared: tuple[str, ...], kills: int) -> bool:
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
        f"{searcher:8}  {workers:>7}  {same:4} of {kills:2}  {min(cut):8,} – {max(cut):8,}  {len(expected):9,}"
        f"  {time.monotonic() - started:7.0f}",
        flush=True,
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
    with contextlib.redirect_stdout(io.StringIO()):
        code = grammarbt(arguments)
    if code != SUCCESS:
        raise SystemExit(f"grammarbt {' '.join(arguments)} exits with {code}")


def _journal(folder: Path) -> bytes:
    return (folder / "journal.jsonl").read_bytes()


if __name__ == "__main__":
    sys.exit(main())
