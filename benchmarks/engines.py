"""Ways to tick a tree that report alike: our own, py_trees, and BehaviorTree.CPP from the exported files."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import count
from typing import TYPE_CHECKING, Any

import behaviortreepy
import py_trees
from attrs import Factory, define, field, frozen

from grammarbt.bt import (
    Action,
    BehaviorTree,
    Condition,
    Parallel,
    Status,
    Ticker,
    flatten,
    leaves,
    numbered,
    ticker,
    walk,
)
from grammarbt.bt.formats import btcpp
from grammarbt.bt.formats import py_trees as py_trees_format
from grammarbt.bt.trace import node_statuses

if TYPE_CHECKING:
    from collections.abc import Iterator

    from console import Console


@frozen
class Seen:
    """What could be seen of a tick; leaves are named by their occurrence, nodes by their place in pre-order."""

    root: Status
    order: tuple[int, ...]
    statuses: dict[int, Status]
    started: tuple[int, ...]
    halted: tuple[int, ...]


def has_parallel(tree: BehaviorTree) -> bool:
    """Whether there is a parallel node in the tree."""
    return any(isinstance(node, Parallel) for node in walk(tree))


@define
class Ours:
    """The flat form, or another ticker; started and halted follow from the leaves ticked.

    Attributes:
        forgets: halt everything before each tick.
        once: ticks the tree once.
    """

    tree: BehaviorTree
    forgets: bool = False
    once: Ticker = field(default=Factory(lambda self: ticker(flatten(self.tree)), takes_self=True))
    running: set[int] = field(factory=set)

    def tick(self, answers: Sequence[Status]) -> Seen:
        """Tick once; `answers` are what the leaves say if asked."""
        asked = _Asked(answers)
        root, order = self.once(asked), asked.order
        found = node_statuses(self.tree, {occurrence: answers[occurrence] for occurrence in order})
        before = set() if self.forgets else self.running
        self.running = _running_after(self.tree, found)
        acting = [at for at in order if isinstance(leaves(self.tree)[at], Action)]
        ran = {at for at in acting if answers[at] is Status.RUNNING}
        halted = (before - set(acting)) | (ran - self.running)
        statuses = {place: status for place, status in enumerate(found) if status is not None}
        return Seen(root, tuple(order), statuses, tuple(at for at in acting if at not in before), tuple(sorted(halted)))


@define
class _Asked:
    """Answers that remember what was asked."""

    answers: Sequence[Status]
    order: list[int] = field(factory=list)

    def __getitem__(self, occurrence: int) -> Status:
        self.order.append(occurrence)
        return self.answers[occurrence]


def _running_after(tree: BehaviorTree, statuses: Sequence[Status | None]) -> set[int]:
    """The leaves that run on: a parallel node that is decided halts those still running below it."""
    runs: list[bool] = []
    found, occurrence = set(), count()
    for (node, parent), status in zip(numbered(tree), statuses, strict=True):
        runs.append(status is Status.RUNNING and (parent is None or runs[parent]))
        if isinstance(node, Action | Condition):
            at = next(occurrence)
            found |= {at} if runs[-1] else set()
    return found


class PyTrees:
    """The exported module, in py_trees."""

    def __init__(self, tree: BehaviorTree) -> None:
        module: dict[str, Any] = {}
        exec(py_trees_format.dumps(tree), module)  # noqa: S102 – loading what was exported is the point
        module["Action"].initialise = lambda leaf: self.started.append(leaf.robot.occurrence)
        self.root = module["create_root"](None)
        self.places = {node.id: place for place, node in enumerate(_pre_order(self.root))}
        leaf_nodes = [node for node in _pre_order(self.root) if not node.children]
        for occurrence, node in enumerate(leaf_nodes):
            node.robot = _Robot(self, occurrence)

    def tick(self, answers: Sequence[Status]) -> Seen:
        """Tick once; `answers` are what the leaves say if asked."""
        self.answers = answers
        self.order: list[int] = []
        self.started: list[int] = []
        self.halted: list[int] = []
        statuses = {self.places[node.id]: Status[node.status.name] for node in self.root.tick()}
        root = Status[self.root.status.name]
        return Seen(root, tuple(self.order), statuses, tuple(self.started), tuple(sorted(self.halted)))


@frozen
class _Robot:
    """What the exported module asks, for one leaf."""

    engine: PyTrees
    occurrence: int

    def condition(self, _: str, **__: str) -> bool:
        return self.answer() is Status.SUCCESS

    def action(self, _: str, **__: str) -> py_trees.common.Status:
        return py_trees.common.Status[self.answer().name]

    def halt(self, _: str, **__: str) -> None:
        self.engine.halted.append(self.occurrence)

    def answer(self) -> Status:
        self.engine.order.append(self.occurrence)
        return self.engine.answers[self.occurrence]


def _pre_order(node: py_trees.behaviour.Behaviour) -> Iterator[py_trees.behaviour.Behaviour]:
    yield node
    for child in node.children:
        yield from _pre_order(child)


class BehaviorTreeCpp:
    """The exported XML, in BehaviorTree.CPP; control nodes are followed through its console logger.

    Its parallel does not tick finished children again while running, so trees with parallel nodes are halted before
    each tick.
    """

    CHANGE = re.compile(rb"\]: #(\d+) .*-> \x1b\[\d+m(\w+)")

    def __init__(self, tree: BehaviorTree, console: Console) -> None:
        self.console = console
        self.halts = has_parallel(tree)
        places = [place for place, (node, _) in enumerate(numbered(tree)) if isinstance(node, Action | Condition)]
        self.occurrences = {place + 1: occurrence for occurrence, place in enumerate(places)}
        xml = _with_numbered_controls(btcpp.dumps(tree))
        factory = behaviortreepy.BehaviorTreeFactory()
        for tag in re.findall(r'<Action ID="(.*?)"', xml):
            factory.register_simple_stateful_action(tag, self.start, self.answer, self.halt)
        for tag in re.findall(r'<Condition ID="(.*?)"', xml):
            factory.register_simple_condition(tag, self.answer)
        self.tree = factory.create_tree_from_text(xml)
        self.logger = behaviortreepy.StdCoutLogger(self.tree)
        self.current: dict[int, str] = {}

    def start(self, node: behaviortreepy.TreeNode) -> behaviortreepy.NodeStatus:
        """An action begins."""
        self.started.append(self.occurrences[node.uid()])
        return self.answer(node)

    def answer(self, node: behaviortreepy.TreeNode) -> behaviortreepy.NodeStatus:
        """A leaf is ticked."""
        occurrence = self.occurrences[node.uid()]
        self.order.append(occurrence)
        self.statuses[node.uid() - 1] = self.answers[occurrence]
        return behaviortreepy.NodeStatus.__members__[self.answers[occurrence].name]

    def halt(self, node: behaviortreepy.TreeNode) -> None:
        """An action is stopped."""
        self.halted.append(self.occurrences[node.uid()])

    def tick(self, answers: Sequence[Status]) -> Seen:
        """Tick once; `answers` are what the leaves say if asked."""
        self.answers = answers
        self.order: list[int] = []
        self.started: list[int] = []
        self.halted: list[int] = []
        self.statuses: dict[int, Status] = {}
        if self.halts:
            self.tree.halt_tree()
            self.changes()
            self.halted.clear()
        root = Status[self.tree.tick_exactly_once().name]
        last = self.changes()
        for place, status in {**self.current, **last}.items():
            if status != "IDLE":
                self.statuses[place] = Status[status]
        return Seen(root, tuple(self.order), self.statuses, tuple(self.started), tuple(sorted(self.halted)))

    def changes(self) -> dict[int, str]:
        """Follow the control nodes; gives the last status but IDLE of those that changed."""
        last: dict[int, str] = {}
        self.logger.flush()
        for found in self.CHANGE.finditer(self.console.read()):
            place, status = int(found.group(1)), found.group(2).decode()
            self.current[place] = status
            if status != "IDLE":
                last[place] = status
        return last


def _with_numbered_controls(xml: str) -> str:
    """Call control nodes by their place in pre-order, which the logger then prints."""
    tree, model = xml.split("<TreeNodesModel>")
    places = count()

    def name(opening: re.Match[str]) -> str:
        place = next(places)
        return f'{opening.group()} name="#{place}"' if opening.group(1) in btcpp.CONTROL else opening.group()

    return "<TreeNodesModel>".join((re.sub(r"(?m)^ {4,}<([\w-]+)", name, tree), model))
