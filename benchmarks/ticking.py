"""How fast a tree is ticked: py_trees, the flat policy, and generated source, beside what compiling costs.

    python benchmarks/ticking.py

All look up the same random answers by the number of the leaf. Times are microseconds, the median over the trees of the
best of several rounds; the factor is py_trees' time over ours. Last, a whole simulation: a `TickDomain` whose leaves do
next to nothing, in episodes of 100 ticks, beside the same world with its tree in py_trees.
"""

from __future__ import annotations

import time
from functools import partial
from itertools import count
from statistics import median
from typing import TYPE_CHECKING

import numpy as np
import py_trees
from random_trees import NAMES, arbitrary, flattened, paper_shaped

from grammarbt.bt import (
    Action,
    BehaviorTree,
    Condition,
    Fallback,
    Leaf,
    Not,
    Status,
    all_pure,
    canonical_key,
    compile_policy,
    compile_source,
    flatten,
    leaves,
    tick,
    ticker,
)
from grammarbt.bt.fingerprint import Fingerprints
from grammarbt.bt.simplify import size
from grammarbt.domain import ActionType, ConditionType, Group, TickDomain, Vocabulary

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

TREES, ROUNDS = 15, 9
ROWS = 200
REPEATS = {"py_trees": 1}
OUR_REPEATS = 50
"""How often the rows are gone through in a round: often enough for the clock, and for what py_trees left in the caches."""

STATUSES = tuple(Status)
EPISODES, TICKS = 100, 100


def main() -> None:
    """Print a table for each shape and size."""
    rng = np.random.default_rng(0)
    for shape in ("paper", "arbitrary"):
        for nodes in (20, 200):
            trees = [random_tree(rng, shape, nodes) for _ in range(TREES)]
            print(f"{shape}, {nodes} nodes ({median(map(size, trees))} in the median)")
            print_ticks(rng, trees)
            print_compiling(trees)
    print_simulating(paper_shaped(rng, 4))


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
        rows = [[int(rng.integers(3 if isinstance(leaf, Action) else 2)) for leaf in leaves(tree)] for _ in range(ROWS)]
        ways = {name: (loop, rows * REPEATS.get(name, OUR_REPEATS)) for name, loop in loops(tree).items()}
        found = fastest([partial(loop, many) for loop, many in ways.values()])
        for (name, (_, many)), seconds in zip(ways.items(), found, strict=True):
            times.setdefault(name, []).append(seconds / len(many))
    return {name: median(found) for name, found in times.items()}


def loops(tree: BehaviorTree) -> dict[str, Callable[[list[list[int]]], None]]:
    """Functions that tick once for each row of answers."""
    world = World()
    root = in_py_trees(tree, lambda leaf, occurrence: LeafOfPyTrees(leaf, world, occurrence), count())
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
    ways = {
        "flat form": flatten,
        "canonical key": canonical_key,
        "fingerprint": Fingerprints(all_pure),
        "generated source": compile_source,
    }
    for name, way in ways.items():
        found = fastest([partial(way, tree) for tree in trees])
        print(f"  to {name:21} {median(found) * 1e6:9.1f} µs a tree")


def print_simulating(tree: BehaviorTree) -> None:
    """Episodes a second of a trivial world."""
    world = Trivial()
    policy, scenarios = compile_policy(tree, world.vocabulary.index), np.arange(EPISODES)
    ours, theirs = fastest([partial(world.simulate, policy, scenarios), partial(simulate_in_py_trees, world, tree)])
    print(f"a trivial TickDomain, {size(tree)} nodes, {TICKS} ticks an episode")
    print(f"  py_trees                 {EPISODES / theirs:9,.0f} episodes a second")
    print(f"  TickDomain               {EPISODES / ours:9,.0f} episodes a second   {theirs / ours:6.0f} ×")


def simulate_in_py_trees(world: Trivial, tree: BehaviorTree) -> None:
    """What `TickDomain.simulate` does, with py_trees ticking."""
    root = in_py_trees(tree, lambda leaf, _: LeafOfWorld(leaf, world), count())
    for scenario in range(EPISODES):
        world.done = False
        world.reset(np.random.default_rng(scenario))
        while not world.done:
            root.tick_once()
            world.step()


def fastest(calls: Sequence[Callable[[], object]]) -> list[float]:
    """Seconds of the processor in each call's fastest round; other programs only ever make a round slower.

    The calls take turns, since a processor may be slower for a while: what is compared then meets the same moments.
    """
    rounds = [[seconds(call) for call in calls] for _ in range(ROUNDS)]
    return [min(found) for found in zip(*rounds, strict=True)]


def seconds(call: Callable[[], object]) -> float:
    """Of the processor."""
    begin = time.process_time()
    call()
    return time.process_time() - begin


class World:
    """What py_trees' leaves look at."""

    row: list[int]


class Trivial(TickDomain):
    """A world of `TICKS` ticks whose leaves answer at once."""

    vocabulary = Vocabulary(
        (Group("all", tuple(ActionType(name) for name in NAMES), tuple(ConditionType(name) for name in NAMES)),)
    )

    def reset(self, _: np.random.Generator) -> None:
        """Start the clock."""
        self.time = 0

    def condition(self, name: str) -> bool:
        """Hold for some names."""
        return name > "a"

    def action(self, _: str) -> Status:
        """Run on."""
        return Status.RUNNING

    def step(self) -> None:
        """Let time pass."""
        self.time += 1
        self.done = self.time == TICKS


ANSWERS = (py_trees.common.Status.FAILURE, py_trees.common.Status.SUCCESS, py_trees.common.Status.RUNNING)


class LeafOfPyTrees(py_trees.behaviour.Behaviour):
    """The least a leaf can do in py_trees: look its answer up."""

    def __init__(self, leaf: Leaf, world: World, occurrence: int) -> None:
        super().__init__(leaf.name)
        self.world, self.occurrence = world, occurrence

    def update(self) -> py_trees.common.Status:
        """Look it up."""
        return ANSWERS[self.world.row[self.occurrence]]


class LeafOfWorld(py_trees.behaviour.Behaviour):
    """A leaf that asks a `Trivial` world."""

    def __init__(self, leaf: Leaf, world: Trivial) -> None:
        super().__init__(leaf.name)
        self.ask = world.action if isinstance(leaf, Action) else world.condition

    def update(self) -> py_trees.common.Status:
        """Ask."""
        return ANSWERS[self.ask(self.name)]


def in_py_trees(
    node: BehaviorTree, make_leaf: Callable[[Leaf, int], py_trees.behaviour.Behaviour], occurrences: count[int]
) -> py_trees.behaviour.Behaviour:
    """The tree built in py_trees, with leaves of some make."""
    if isinstance(node, Action | Condition):
        return make_leaf(node, next(occurrences))
    if isinstance(node, Not):
        return py_trees.decorators.Inverter("not", in_py_trees(node.child, make_leaf, occurrences))
    parts = [in_py_trees(child, make_leaf, occurrences) for child in node.children]
    if isinstance(node, Fallback):
        return py_trees.composites.Selector("fallback", memory=False, children=parts)
    return py_trees.composites.Sequence("sequence", memory=False, children=parts)


if __name__ == "__main__":
    main()
