"""What searching costs besides simulating, as the graph of a search grows: microseconds an iteration, bytes a node.

    python benchmarks/dag_scale.py --iterations 100000
    python benchmarks/dag_scale.py --nodes 1000000 --searcher dagmcts preset=paper restarts=false

The searcher proposes trees and is told made-up returns that depend on tree and scenario alone. Time is processor time of
`ask` and `tell`; memory is what the process gained since the searcher was made.
"""

from __future__ import annotations

import argparse
import time
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
    from grammarbt.search import Proposal, Searcher

DOMAIN = f"{Path(__file__).with_name('clockwork.py')}:Clockwork"
FIRST_ITERATIONS = 1_024


def main() -> None:
    """Print a row each time the iterations have doubled."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nodes", type=int, default=1_000_000, help="where to end")
    parser.add_argument("--iterations", type=int, default=20_000_000, help="or where to end")
    parser.add_argument("--domain", default=DOMAIN)
    parser.add_argument("--searcher", nargs="+", default=["dagmcts"], metavar=("NAME", "KEY=VALUE"))
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
    print("     nodes  iterations  µs an iteration  bytes a node")
    grow(searcher, arguments.nodes, arguments.iterations)


def grow(searcher: Searcher, nodes: int, most: int) -> None:
    """Search until there are so many nodes or iterations, or nothing is left to propose."""
    before, seconds, iterations, row = resident(), 0.0, 0, FIRST_ITERATIONS
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
            show(searcher, seconds, iterations, resident() - before)
    show(searcher, seconds, iterations, resident() - before)


def show(searcher: Searcher, seconds: float, iterations: int, gained: int) -> None:
    """One row."""
    nodes = int(searcher.metrics()["nodes"])
    print(
        f"{nodes:10,}  {iterations:10,}  {seconds / max(iterations, 1) * 1e6:15.1f}  {gained / nodes:12.0f}", flush=True
    )


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
