"""Ticks random trees in the flat form, from generated source, in py_trees and in BehaviorTree.CPP, and counts differences.

    python benchmarks/oracles.py --ticks 200000

Compared with the flat form in each tick: the root's status, the leaves in the order ticked, the status of every node ticked, the actions
started and the actions halted.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from typing import TYPE_CHECKING

import numpy as np
from console import Console
from engines import BehaviorTreeCpp, Ours, PyTrees, has_parallel
from random_trees import arbitrary, flattened, paper_shaped

from grammarbt.bt import Action, BehaviorTree, Status, compile_source, format_tree, leaves

if TYPE_CHECKING:
    from collections.abc import Sequence

TICKS_PER_TREE = 20
PARTS = ("root", "order", "statuses", "started", "halted")


def main() -> int:
    """Print the counts; 1 when anything differs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--ticks", type=int, default=20_000, help="ticks in all")
    parser.add_argument("--seed", type=int, default=0, help="of trees and answers")
    options = parser.parse_args()
    counts: Counter[str] = Counter()
    with Console() as console:
        differing = compare(options.ticks, options.seed, console, counts)
    for name, number in counts.items():
        print(f"{name:32} {number:9,}")
    print("\n".join(["", "trees that differ:", *differing]) if differing else "no tree differs")
    return 1 if differing else 0


def compare(ticks: int, seed: int, console: Console, counts: Counter[str]) -> list[str]:
    """Tick random trees and count; gives the trees that differ, in notation."""
    rng = np.random.default_rng(seed)
    differing = []
    for number in range(-(-ticks // TICKS_PER_TREE)):
        tree = _random_tree(rng, number)
        answers = [_random_answers(rng, tree) for _ in range(TICKS_PER_TREE)]
        counts["trees"] += 1
        counts["trees with parallel nodes"] += has_parallel(tree)
        counts["ticks"] += len(answers)
        pairs = {
            "generated source": (Ours(tree), Ours(tree, once=compile_source(tree))),
            "py_trees": (Ours(tree), PyTrees(tree)),
            "BehaviorTree.CPP": (Ours(tree, forgets=has_parallel(tree)), BehaviorTreeCpp(tree, console)),
        }
        if sum([_count_differences(name, *pair, answers, counts) for name, pair in pairs.items()]):
            differing.append(format_tree(tree))
    return differing


def _random_tree(rng: np.random.Generator, number: int) -> BehaviorTree:
    """Paper-shaped, arbitrary, and arbitrary with parallel nodes in turn."""
    kind = ("paper", "arbitrary", "parallel")[number % 3]
    if kind == "paper":
        return paper_shaped(rng, int(rng.integers(1, 6)))
    return flattened(arbitrary(rng, int(rng.integers(1, 25)), parallel=kind == "parallel"))


def _random_answers(rng: np.random.Generator, tree: BehaviorTree) -> list[Status]:
    """What each leaf says if asked; conditions never run."""
    return [Status(int(rng.integers(3 if isinstance(leaf, Action) else 2))) for leaf in leaves(tree)]


def _count_differences(
    name: str,
    ours: Ours,
    other: Ours | PyTrees | BehaviorTreeCpp,
    answers: Sequence[Sequence[Status]],
    counts: Counter[str],
) -> int:
    differences = 0
    for row in answers:
        mine, theirs = ours.tick(row), other.tick(row)
        counts[f"{name}: leaves ticked"] += len(theirs.order)
        counts[f"{name}: nodes compared"] += len(theirs.statuses)
        counts[f"{name}: started"] += len(theirs.started)
        counts[f"{name}: halted"] += len(theirs.halted)
        for part in PARTS:
            counts[f"{name}: {part} differs"] += getattr(mine, part) != getattr(theirs, part)
        differences += mine != theirs
    return differences


if __name__ == "__main__":
    sys.exit(main())
