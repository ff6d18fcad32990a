"""What common worlds save when two trees are compared: `python benchmarks/paired.py [--domain marine] [--scenarios N]`.

Prints the standard deviation of a return, and of the difference between the domain's first reference tree and that tree
with two neighbouring sub-trees exchanged: in the same scenarios, and in different ones. The last column is how many
times the episodes different scenarios take for an equally sure answer; the mean is over all exchanges.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

import numpy as np
from attrs import evolve

from grammarbt.bt import Fallback, compile_policy, parse
from grammarbt.domain import scenario_numbers
from grammarbt.plugins import PluginHost, PluginOptions, Registry

if TYPE_CHECKING:
    from collections.abc import Iterator

    from grammarbt.bt import BehaviorTree
    from grammarbt.domain import Domain

SEED = 100


def main() -> None:
    """Print a line per exchange, and their mean."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--domain", default="marine")
    parser.add_argument("--scenarios", type=int, default=2_000)
    arguments = parser.parse_args()
    domain = Registry(PluginHost(PluginOptions(), lambda _: None)).make_domain(arguments.domain, {})
    tree = parse(domain.references[0].tree)
    here, there = (returns(domain, tree, start, arguments.scenarios) for start in (0, arguments.scenarios))
    print("exchange  sd of a return  sd, same worlds  sd, other worlds  episodes saved")
    factors = []
    for number, other in enumerate(exchanges(tree), 1):
        theirs = returns(domain, other, 0, arguments.scenarios)
        common, different = (theirs - here).std(ddof=1), (theirs - there).std(ddof=1)
        factors.append((different / common) ** 2)
        print(f"{number:8}  {theirs.std(ddof=1):14.1f}  {common:15.1f}  {different:16.1f}  {factors[-1]:13.1f}×")
    print(f"mean of the last column: {np.mean(factors):.1f}")


def returns(domain: Domain, tree: BehaviorTree, start: int, n: int) -> np.ndarray:
    """The tree's returns in n scenarios."""
    policy = compile_policy(tree, domain.vocabulary.index)
    return domain.simulate(policy, scenario_numbers(SEED, start, start + n)).returns


def exchanges(tree: BehaviorTree) -> Iterator[BehaviorTree]:
    """The tree with each two neighbours at its root exchanged."""
    if isinstance(tree, Fallback):
        for at in range(len(tree.children) - 1):
            first, second = tree.children[at : at + 2]
            yield evolve(tree, children=(*tree.children[:at], second, first, *tree.children[at + 2 :]))


if __name__ == "__main__":
    main()
