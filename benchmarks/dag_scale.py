"""What searching costs besides simulating, as the graph of a search grows: microseconds an iteration, bytes a node.

    python benchmarks/dag_scale.py --iterations 100000
    python benchmarks/dag_scale.py --nodes 1000000 --searcher dagmcts preset=paper restarts=false
    python benchmarks/dag_scale.py --iterations 20000 --split --searcher dagmcts preset=paper restarts=false

The searcher proposes trees and is told made-up returns that depend on tree and scenario alone. Time is processor time of
`ask` and `tell`, on average from the beginning and since the row before; memory is what the process gained since the
searcher was made. `--split` says at the end which parts of the published methods the time went to, by samples that the
interpreter takes now and then.
"""

from __future__ import annotations

import argparse
import signal
import time
from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING
from zlib import crc32

from grammarbt.bt import format_tree, leaves
from grammarbt.plugins import PluginHost, PluginOptions, Registry
from grammarbt.run.setup import prepare
from grammarbt.run.spec import RunSpec
from grammarbt.search import Evaluation

if TYPE_CHECKING:
    from types import FrameType

    from grammarbt.search import Proposal, Searcher

DOMAIN = f"{Path(__file__).with_name('clockwork.py')}:Clockwork"
FIRST_ITERATIONS = 1_024
SAMPLE_EVERY = 0.002
PARTS = {
    "_best_edge": "selection",
    "link": "ancestor links",
    "_expand": "expansion",
    "below": "roll-out",
    "learn": "backup",
    "made_up": "",
    "_advance": "the rest",
}
"""The function that a sample is in, the innermost of these, and what the time in it is spent on."""


def main() -> None:
    """Print a row each time the iterations have doubled."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nodes", type=int, default=1_000_000, help="where to end")
    parser.add_argument("--iterations", type=int, default=20_000_000, help="or where to end")
    parser.add_argument("--domain", default=DOMAIN)
    parser.add_argument("--searcher", nargs="+", default=["dagmcts"], metavar=("NAME", "KEY=VALUE"))
    parser.add_argument("--split", action="store_true", help="say which parts the time went to")
    arguments = parser.parse_args()
    name, *settings = arguments.searcher
    with TemporaryDirectory() as folder:
        given = dict(setting.split("=", 1) for setting in settings)
        spec = RunSpec(
            domain=arguments.domain,
            searcher=name,
            budget=10 * arguments.iterations,
            out=folder,
            set={"searcher": given},
        )
        searcher = prepare(spec, Registry(PluginHost(PluginOptions(), print))).searcher
    samples: Counter[str] = Counter()
    if arguments.split:
        signal.signal(signal.SIGPROF, lambda _, frame: samples.update([part_of(frame)]))
        signal.setitimer(signal.ITIMER_PROF, SAMPLE_EVERY, SAMPLE_EVERY)
    print("     nodes  iterations  µs an iteration  of late  bytes a node")
    grow(searcher, arguments.nodes, arguments.iterations)
    signal.setitimer(signal.ITIMER_PROF, 0.0)
    for part in filter(None, PARTS.values()):
        if samples[part]:
            print(f"{part:>20} {samples[part] / (samples.total() - samples['']):4.0%}")


def part_of(frame: FrameType | None) -> str:
    """What the interpreter is at; nothing if it is at none of the searcher's parts."""
    while frame is not None and frame.f_code.co_name not in PARTS:
        frame = frame.f_back
    return "" if frame is None else PARTS[frame.f_code.co_name]


def grow(searcher: Searcher, nodes: int, most: int) -> None:
    """Search until there are so many nodes or iterations, or nothing is left to propose."""
    before, seconds, iterations, row = resident(), 0.0, 0, FIRST_ITERATIONS
    last = 0, 0.0
    while iterations < most and searcher.metrics()["nodes"] < nodes:
        started = time.process_time()
        proposals = searcher.ask(1)
        between = time.process_time()
        evaluations = [made_up(proposal) for proposal in proposals]
        resumed = time.process_time()
        searcher.tell(evaluations)
        seconds += time.process_time() - resumed + between - started
        iterations += len(proposals)
        if not proposals:
            break
        if iterations == row:
            row *= 2
            show(searcher, (iterations, seconds), last, resident() - before)
            last = iterations, seconds
    if iterations > last[0]:
        show(searcher, (iterations, seconds), last, resident() - before)


def show(searcher: Searcher, now: tuple[int, float], last: tuple[int, float], gained: int) -> None:
    """One row; iterations and seconds now and in the row before."""
    nodes = int(searcher.metrics()["nodes"])
    mean, late = (1e6 * (now[1] - then[1]) / (now[0] - then[0]) for then in ((0, 0.0), last))
    print(f"{nodes:10,}  {now[0]:10,}  {mean:15.1f}  {late:7.1f}  {gained / nodes:12.0f}", flush=True)


def made_up(proposal: Proposal) -> Evaluation:
    """Returns between 0 and 1; every leaf is ticked once."""
    tree = crc32(format_tree(proposal.tree).encode())
    returns = tuple(
        (crc32(scenario.to_bytes(8), tree) % 997 + tree % 97) / 1094
        for scenario in range(proposal.start, proposal.stop)
    )
    return Evaluation(proposal, returns, (1,) * len(leaves(proposal.tree)))


def resident() -> int:
    """Bytes of memory that the process has."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * 4096


if __name__ == "__main__":
    main()
