"""How long the report of a long run takes to write and to open, and how large it is.

    python benchmarks/report_large.py [TRIALS]

The journal is made up: trees of thirty leaves, a new best tree after every thousandth trial. Opening is timed in Chromium,
from the navigation until the page has been laid out and drawn.
"""

import json
import shutil
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import sync_playwright

from grammarbt.cli import main
from grammarbt.run.folder import RunFolder
from grammarbt.run.journal import Journal, encoded

LEAVES, IMPROVES, AT_ONCE = 30, 1000, 10_000
CORRIDOR = f"{Path(__file__).parents[1] / 'docs' / 'examples' / 'corridor.py'}:Corridor"


def write_run(folder: RunFolder, trials: int) -> None:
    """A finished run of so many trials."""
    small = ["--searcher", "random", "--budget", "20", "--validation", "20", "--out", str(folder.path), "--quiet"]
    if main(["run", "--domain", CORRIDOR, *small]):
        sys.exit("the small run failed")
    folder.journal.unlink()
    journal = Journal.open(folder.journal)
    for first in range(0, trials, AT_ONCE):
        journal.append([encoded(trial(number)) for number in range(first, min(trials, first + AT_ONCE))])
    tree = trial(trials - 1)["tree"]
    journal.append([encoded({"event": "searched", "stopped": "budget", "trials": trials, "episodes": trials})])
    validation = {"event": "validation", "name": "best", "tree": tree, "mean": 1.0, "stderr": 0.1, "episodes": 9}
    journal.append([encoded(validation)])
    finished = {"event": "finished", "tree": tree, "trials": trials, "episodes": trials, "complete": None}
    journal.append([encoded(finished)])
    journal.close()
    folder.timing.write_text("".join(timing(trials)), encoding="utf-8")


def trial(number: int) -> dict[str, object]:
    """A trial of a tree that no other trial has."""
    leaves = " ".join(f"[act {(number + at) % 97}]" for at in range(LEAVES))
    value = float(number if number % IMPROVES == 0 else -1)
    return {
        "event": "trial", "tree": f"?( (asked {number}) {leaves} )", "start": 0, "stop": 1, "simulated": 1,
        "status": "ok", "returns": [value], "ticks": [], "batch": number + 1,
    }  # fmt: skip


def timing(trials: int) -> Iterator[str]:
    """A line for every hundred trials."""
    for at in range(0, trials, 100):
        metrics = {"nodes": float(at), "restarts": at // 1000, "depth": 7.0}
        yield json.dumps({"batch": at, "episodes": 100, "seconds": at / 1000, "metrics": metrics}) + "\n"


def seconds_to_open(path: Path) -> float:
    """In Chromium, until the first picture has been drawn."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        page = browser.new_page()
        page.goto("about:blank")
        start = time.perf_counter()
        page.goto(path.as_uri())
        page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        found = time.perf_counter() - start
        browser.close()
    return found


def measure(trials: int) -> None:
    """Print a line."""
    with TemporaryDirectory() as place:
        folder = RunFolder(Path(place) / "run")
        write_run(folder, trials)
        start = time.perf_counter()
        main(["report", str(folder.path), "--episodes", "0"])
        written = time.perf_counter() - start
        page = folder.path / "report.html"
        size, journal = page.stat().st_size, folder.journal.stat().st_size
        print("   trials  journal MB  written in s  page MB  opened in s")
        print(f"{trials:9,}  {journal / 1e6:10.1f}  {written:12.1f}  {size / 1e6:7.2f}  {seconds_to_open(page):11.2f}")


if __name__ == "__main__":
    measure(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000)
