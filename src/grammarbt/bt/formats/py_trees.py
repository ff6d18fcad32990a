"""A Python module that builds the tree in py_trees 2.

Control nodes have no memory, so each tick starts at the root, as ours do. py_trees' own parallel ticks every child and
fails with the first that fails; the module brings one that counts.
"""

from __future__ import annotations

from grammarbt.bt.formats.unique import UniqueNames
from grammarbt.bt.model import Action, BehaviorTree, Condition, Fallback, Node, Not, Parallel, children, walk
from grammarbt.bt.notation import format_tree

_HEAD = """\
# A behavior tree for py_trees 2, exported by grammarbt:
#
#     {notation}
#
# create_root(robot) builds it. The robot has three methods:
#
#     robot.action(name, **arguments)     does one step; returns py_trees.common.Status SUCCESS, FAILURE or RUNNING
#     robot.condition(name, **arguments)  returns True or False
#     robot.halt(name, **arguments)       stops an action that was RUNNING and is no longer wanted
#
# When the tree turns from one running action to another, the new one is ticked before the old one is halted.

import py_trees
from py_trees.common import Status
from py_trees.composites import Selector, Sequence
from py_trees.decorators import Inverter


class Condition(py_trees.behaviour.Behaviour):
    def __init__(self, unique_name, robot, name, arguments):
        super().__init__(unique_name)
        self.robot, self.leaf, self.arguments = robot, name, arguments

    def update(self):
        return Status.SUCCESS if self.robot.condition(self.leaf, **self.arguments) else Status.FAILURE


class Action(py_trees.behaviour.Behaviour):
    def __init__(self, unique_name, robot, name, arguments):
        super().__init__(unique_name)
        self.robot, self.leaf, self.arguments = robot, name, arguments

    def update(self):
        return self.robot.action(self.leaf, **self.arguments)

    def terminate(self, new_status):
        # py_trees also terminates actions that have finished; self.status still is the status before
        if self.status == Status.RUNNING and new_status == Status.INVALID:
            self.robot.halt(self.leaf, **self.arguments)
"""

_PARALLEL = '''

class Parallel(py_trees.composites.Composite):
    """Ticks its children left to right until so many succeed, or so many can no longer be reached."""

    def __init__(self, name, successes, children):
        super().__init__(name, children)
        self.successes = successes

    def tick(self):
        won = lost = 0
        status = Status.RUNNING
        for index, child in enumerate(self.children):
            yield from child.tick()
            won += child.status == Status.SUCCESS
            lost += child.status == Status.FAILURE
            if won == self.successes or lost > len(self.children) - self.successes:
                status = Status.SUCCESS if won == self.successes else Status.FAILURE
                self.invalidate(self.children[index + 1 :])
                break
        self.current_child = child
        if status == Status.RUNNING:
            self.status = status
        else:
            self.invalidate(other for other in self.children if other.status == Status.RUNNING)
            self.stop(status)
        yield self

    def invalidate(self, children):
        for child in children:
            if child.status != Status.INVALID:
                child.stop(Status.INVALID)
'''


def dumps(tree: BehaviorTree) -> str:
    """Write a Python module with a function `create_root(robot)`."""
    writer = _Writer()
    root = writer.write(tree)
    body = "\n".join(["\n\ndef create_root(robot):", *writer.lines, f"    return {root}\n"])
    parallel = _PARALLEL if any(isinstance(node, Parallel) for node in walk(tree)) else ""
    return _HEAD.format(notation=format_tree(tree)) + parallel + body


class _Writer:
    """One assignment a node, children first: Python would not read nested calls as deep as trees may be."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.unique = UniqueNames()

    def write(self, node: Node) -> str:
        parts = [self.write(child) for child in children(node)]
        variable = f"node_{len(self.lines) + 1}"
        self.lines.append(f"    {variable} = {_expression(node, self.unique.name(node), parts)}")
        return variable


def _expression(node: Node, name: str, parts: list[str]) -> str:
    if isinstance(node, Action | Condition):
        return f"{type(node).__name__}({name!r}, robot, {node.name!r}, {dict(node.arguments)!r})"
    if isinstance(node, Not):
        return f"Inverter({name!r}, {parts[0]})"
    inside = f"[{', '.join(parts)}]"
    if isinstance(node, Parallel):
        return f"Parallel({name!r}, {node.successes}, {inside})"
    return f"{'Selector' if isinstance(node, Fallback) else 'Sequence'}({name!r}, memory=False, children={inside})"
