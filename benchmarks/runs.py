"""What a run costs besides simulating: microseconds per trial, parallel efficiency, memory over many trials, resuming.

python benchmarks/runs.py overhead              # framework and searcher, µs of processor time per trial
python benchmarks/runs.py parallel              # efficiency on 2 workers at 20 ms a simulation
python benchmarks/runs.py long --trials 1000000  # resident memory over a long run, and how fast it is opened again
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

from grammarbt.plugins import PluginHost, PluginOptions, Registry
from grammarbt.run.execute import execute
from grammarbt.run.setup import prepare
from grammarbt.run.spec import RunSpec
from grammarbt.run.watch import Watcher

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

DOMAIN = f"{Path(__file__).with_name('clockwork.py')}:Clockwork"
COMMAND = (sys.executable, "-m", "grammarbt")
MEGABYTE = 1_000_000


def main() -> int:
    """Print one table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", choices=["overhead", "parallel", "long"])
    parser.add_argument("--trials", type=int, default=0, help="20,000, 400 or 1,000,000 unless given")
    parser.add_argument("--milliseconds", type=float, default=0.0, help="a simulation's; 1 or 20 unless given")
    parser.add_argument("--asleep", action="store_true", help="simulations sleep instead of keeping a core busy")
    options = parser.parse_args()
    if options.table == "overhead":
        overhead(options.trials or 20_000, options.milliseconds or 1.0)
    elif options.table == "parallel":
        parallel(options.trials or 400, options.milliseconds or 20.0, asleep=options.asleep)
    else:
        long(options.trials or 1_000_000)
    return 0


class Stopwatch:
    """Adds up the processor time of calls, and counts them: each costs a few reads of the clock too."""

    def __init__(self) -> None:
        self.seconds, self.calls = 0.0, 0

    def timed(self, call: Callable[..., object]) -> Callable[..., object]:
        """The call, its time added up here."""

        def measured(*arguments: object) -> object:
            started = time.process_time()
            try:
                return call(*arguments)
            finally:
                self.seconds += time.process_time() - started
                self.calls += 1

        return measured

    @classmethod
    def cost(cls, calls: int = 10_000) -> float:
        """Processor time that measuring adds to a call, outside of what is measured."""
        watch, started = cls(), time.process_time()
        nothing = watch.timed(lambda: None)
        for _ in range(calls):
            nothing()
        return (time.process_time() - started - watch.seconds) / calls


def overhead(trials: int, milliseconds: float) -> None:
    """Processor time per trial, in which the domain, the searcher and the rest are told apart."""
    print("simulation      trials  batch  simulating  searching  framework   framework's share")
    for seconds, batch in product((0.0, milliseconds / 1_000), (1, 16, 64)):
        number = trials if seconds == 0.0 else min(trials, 20_000)
        with tempfile.TemporaryDirectory() as scratch:
            spec = _spec(Path(scratch) / "run", number, batch=batch, set={"domain": {"seconds": seconds}})
            setup = prepare(spec, Registry(PluginHost(PluginOptions(), print)))
            domain, searcher, search = Stopwatch(), Stopwatch(), _Search()
            type(setup.domain).simulate = domain.timed(type(setup.domain).simulate)  # type: ignore[method-assign, assignment]
            for method in ("ask", "tell"):
                setattr(setup.searcher, method, searcher.timed(getattr(setup.searcher, method)))
            execute(setup, search)
        each = [part / number * 1e6 for part in (domain.seconds, searcher.seconds, search.seconds)]
        measuring = Stopwatch.cost() * (domain.calls + searcher.calls) / number * 1e6
        rest = each[2] - each[0] - each[1] - measuring
        print(
            f"{seconds * 1e3:7.1f} ms  {number:10,}  {batch:5}  {each[0]:7.1f} µs  {each[1]:6.1f} µs  {rest:6.1f} µs"
            f"  {rest / (each[0] + each[1] + rest):10.1%}"
        )


class _Search(Watcher):
    """The processor time of the search phase."""

    def __init__(self) -> None:
        self.seconds = 0.0
        self._started: float | None = None

    def phase(self, name: str, episodes: int) -> None:
        """Start with the search, stop with what follows it."""
        del episodes
        if name == "searching":
            self._started = time.process_time()
        elif self._started is not None:
            self.seconds, self._started = time.process_time() - self._started, None


def parallel(trials: int, milliseconds: float, *, asleep: bool) -> None:
    """Wall time of one worker over twice that of two, taken turn by turn."""
    print("workers   seconds   efficiency")
    settings: dict[str, object] = {"seconds": milliseconds / 1_000, "busy": not asleep}
    for _ in range(3):
        alone = _search_seconds(trials, settings, 1)
        together = _search_seconds(trials, settings, 2)
        print(f"1       {alone:9.2f}\n2       {together:9.2f}  {alone / together / 2:10.1%}")


def _search_seconds(trials: int, settings: dict[str, object], workers: int) -> float:
    with tempfile.TemporaryDirectory() as scratch:
        spec = _spec(
            Path(scratch) / "run", trials, set={"domain": settings}, batch=16, workers=workers, executor="processes"
        )
        setup = prepare(spec, Registry(PluginHost(PluginOptions(), print)))
        _warm(setup.executor, workers)
        return execute(setup, Watcher()).seconds


def _warm(executor: Executor, workers: int) -> None:
    """Start all workers."""
    calls: list[Future[None]] = [executor.submit(time.sleep, 1) for _ in range(workers)]
    for call in calls:
        call.result()


def long(trials: int) -> None:
    """Resident memory while a run goes on; then what it takes to open and replay it, with a snapshot and without."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "run"
        arguments = ("run", "--searcher", "random", "--domain", DOMAIN, "--trials", str(trials), "--validation", "2")
        with _timed(f"{trials:,} trials"):
            _watched((*arguments, "--budget", str(2 * trials), "--quiet", "--out", str(folder)), folder)
        print(f"the journal has {(folder / 'journal.jsonl').stat().st_size / MEGABYTE:,.0f} MB")
        for name in ("with its last snapshot", "without a snapshot"):
            with _timed(f"resuming {name}"):
                _finish("resume", str(folder), "--quiet")
            (folder / "snapshot.json").unlink(missing_ok=True)


def _finish(*arguments: str) -> None:
    subprocess.run([*COMMAND, *arguments], check=True, stdout=subprocess.DEVNULL)


@contextmanager
def _timed(what: str) -> Iterator[None]:
    """Say how long processes took, on the clock and of processor time."""
    started, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    yield
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    busy = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(f"{what}: {time.monotonic() - started:.0f} s, of which {busy:.0f} s of processor time", flush=True)


def _watched(arguments: tuple[str, ...], folder: Path) -> None:
    """Finish a run, and print its memory now and then."""
    print("journal, MB   resident, MB")
    with subprocess.Popen([*COMMAND, *arguments], stdout=subprocess.DEVNULL) as process:
        due = time.monotonic()
        while process.poll() is None:
            time.sleep(0.5)
            journal = folder / "journal.jsonl"
            if time.monotonic() >= due and journal.exists():
                due += 15.0
                print(f"{journal.stat().st_size / MEGABYTE:11,.0f}   {_resident(process.pid):12,.0f}", flush=True)


def _resident(pid: int) -> float:
    pages = int(Path(f"/proc/{pid}/statm").read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / MEGABYTE


def _spec(folder: Path, trials: int, **fields: object) -> RunSpec:
    given = {"domain": DOMAIN, "searcher": "random", "validation": 2, "selection": 0.0, "out": str(folder)}
    return RunSpec(**{**given, "budget": 2 * trials, "trials": trials, **fields})  # type: ignore[arg-type]


if __name__ == "__main__":
    sys.exit(main())
