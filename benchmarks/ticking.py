"""How fast a tree is ticked: py_trees, the flat policy, and generated source, beside what compiling costs.

    python benchmarks/ticking.py

All read the same random answers by the number of the leaf. Times are microseconds, the median over the trees of the
best of several rounds; the factor is py_trees' time over ours.
"""

from __future__ import annotations

import time
from itertools import count
from statistics import median
from typing import TYPE_CHECKING

import numpy as np
import py_trees
from random_trees import arbitrary, flattened, paper_shaped

from grammarbt.bt import Action, BehaviorTree, Condition, Fallback, Leaf, Not, Status, flatten, leaves, tick
from grammarbt.bt.canonical import canonical_key
from grammarbt.bt.generate import compile_source
from grammarbt.bt.linked import ticker
from grammarbt.bt.simplify import size

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

TREES, ROUNDS = 15, 5
ROWS = {"py_trees": 100}
OUR_ROWS = 2_000
STATUSES = tuple(Status)


def main() -> None:
    """Print a table for each shape and size."""
    rng = np.random.default_rng(0)
    for shape in ("paper", "arbitrary"):
        for nodes in (20, 200):
            trees = [random_tree(rng, shape, nodes) for _ in range(TREES)]
            print(f"{shape}, {nodes} nodes ({median(map(size, trees))} in the median)")
            print_ticks(rng, trees)
            print_compiling(trees)


def random_tree(rng: np.random.Generator, shape: str, nodes: int) -> BehaviorTree:
    """The first of random trees of growing size that has so many nodes, or a few more."""
    for number in count(1):
        tree = paper_shaped(rng, number) if shape == "paper" else flattened(arbitrary(rng, number, parallel=False))
        if size(tree) >= nodes:
            return tree
    raise AssertionError


def print_ticks(rng: np.random.Generator, trees: Iterable[BehaviorTree]) -> None:
    """One line for each way of ticking."""
    times = seconds_a_tick(rng, trees)
    for name, found in times.items():
        print(f"  {name:24} {found * 1e6:9.3f} µs a tick   {times['py_trees'] / found:6.0f} ×")


def seconds_a_tick(rng: np.random.Generator, trees: Iterable[BehaviorTree]) -> dict[str, float]:
    """For each way of ticking, the median over the trees."""
    times: dict[str, list[float]] = {}
    for tree in trees:
        rows = [
            [int(rng.integers(3 if isinstance(leaf, Action) else 2)) for leaf in leaves(tree)] for _ in range(OUR_ROWS)
        ]
        for name, loop in loops(tree).items():
            few = rows[: ROWS.get(name, OUR_ROWS)]
            times.setdefault(name, []).append(best(lambda loop=loop, few=few: loop(few)) / len(few))
    return {name: median(found) for name, found in times.items()}


def loops(tree: BehaviorTree) -> dict[str, Callable[[list[list[int]]], None]]:
    """Functions that tick once for each row of answers."""
    world = World()
    root = in_py_trees(tree, world, count())
    flat = flatten(tree)

    def tick_py_trees(rows: list[list[int]]) -> None:
        for world.row in rows:
            root.tick_once()

    def tick_with_callback(rows: list[list[int]]) -> None:
        for row in rows:
            tick(flat, lambda _, occurrence, row=row: STATUSES[row[occurrence]])

    def loop(ticks: Callable[[list[int]], Status]) -> Callable[[list[list[int]]], None]:
        def tick_all(rows: list[list[int]]) -> None:
            for row in rows:
                ticks(row)

        return tick_all

    return {
        "py_trees": tick_py_trees,
        "flat, asking a function": tick_with_callback,
        "flat": loop(ticker(flat)),
        "generated source": loop(compile_source(tree)),
    }


def print_compiling(trees: list[BehaviorTree]) -> None:
    """What it costs to get there, once for each tree."""
    ways = {"flat form": flatten, "canonical key": canonical_key, "generated source": compile_source}
    for name, way in ways.items():
        found = [best(lambda way=way, tree=tree: way(tree)) for tree in trees]
        print(f"  to {name:21} {median(found) * 1e6:9.1f} µs a tree")


def best(call: Callable[[], object]) -> float:
    """Seconds of the fastest round; other programs only ever make a round slower."""
    seconds = []
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - begin)
    return min(seconds)


class World:
    """What py_trees' leaves look at."""

    row: list[int]


class LeafOfPyTrees(py_trees.behaviour.Behaviour):
    """The least a leaf can do in py_trees: look its answer up."""

    ANSWERS = (py_trees.common.Status.FAILURE, py_trees.common.Status.SUCCESS, py_trees.common.Status.RUNNING)

    def __init__(self, leaf: Leaf, world: World, occurrence: int) -> None:
        super().__init__(leaf.name)
        self.world, self.occurrence = world, occurrence

    def update(self) -> py_trees.common.Status:
        """Look it up."""
        return self.ANSWERS[self.world.row[self.occurrence]]


def in_py_trees(node: BehaviorTree, world: World, occurrences: count[int]) -> py_trees.behaviour.Behaviour:
    """The tree built in py_trees."""
    if isinstance(node, Action | Condition):
        return LeafOfPyTrees(node, world, next(occurrences))
    if isinstance(node, Not):
        return py_trees.decorators.Inverter("not", in_py_trees(node.child, world, occurrences))
    parts = [in_py_trees(child, world, occurrences) for child in node.children]
    if isinstance(node, Fallback):
        return py_trees.composites.Selector("fallback", memory=False, children=parts)
    return py_trees.composites.Sequence("sequence", memory=False, children=parts)


if __name__ == "__main__":
    main()
