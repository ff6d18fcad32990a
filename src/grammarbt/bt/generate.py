"""Python source of a tick, for simulations that are long enough to pay for compiling it.

A tree becomes one expression of `and`, `or` and `not`, whose jumps Python compiles itself. Only numbers stand in it,
never a leaf's name. `s` is the answer of the last action; when it is running, nothing more is asked. An expression is
true either on success alone (*strictly*, as `and` needs it) or on success and running (as `or` needs it).
"""

from __future__ import annotations

from itertools import count, takewhile
from typing import TYPE_CHECKING, Any

from grammarbt.bt.model import Action, BehaviorTree, Condition, Fallback, Node, Not, Parallel, Sequence, leaves, walk
from grammarbt.bt.status import Status

if TYPE_CHECKING:
    from grammarbt.bt.linked import Ticker

_MAX_NESTING = 60
"""Control nodes in one expression, at two parentheses each; Python's own reader gives up at 200 nested ones."""


def compile_source(tree: BehaviorTree) -> Ticker:
    """A function that ticks the tree once and gives the root's status, from generated source."""
    names: dict[str, Any] = {status.name: status for status in Status}
    exec(compile(generate_source(tree), "<behavior tree>", "exec"), names)  # noqa: S102 – nothing but numbers enters
    ticker: Ticker = names["tick"]
    return ticker


def generate_source(tree: BehaviorTree) -> str:
    """Source of a function `tick(a)`, where `a[i]` is asked when the leaf of occurrence i is ticked."""
    writer = _Writer()
    writer.waiting.append(("tick", tree, 0))
    while writer.waiting:
        writer.function(*writer.waiting.pop())
    return "\n".join(writer.lines) + "\n"


class _Writer:
    """Writes functions: the tree's, and those of parallel nodes, their children, and what is nested too deeply.

    Attributes:
        lines: what is written.
        waiting: functions yet to be written, each with its first leaf's occurrence.
    """

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.waiting: list[tuple[str, Node, int]] = []
        self._names = count(1)
        self._occurrence = 0

    def function(self, name: str, node: Node, occurrence: int) -> None:
        """Write the function that ticks `node`."""
        self._occurrence = occurrence
        body = self._counting(node) if isinstance(node, Parallel) else self._deciding(node)
        self.lines += [f"def {name}(a):", *body]

    def _deciding(self, node: Node) -> list[str]:
        expression = self._expression(node, 0, strict=False)
        result = ["        return RUNNING if s == 2 else SUCCESS", "    return FAILURE"]
        return ["    s = 0", f"    if {expression}:", *result]

    def _counting(self, node: Parallel) -> list[str]:
        lines, allowed = ["    won = lost = 0"], len(node.children) - node.successes
        for part in node.children:
            lines += [f"    s = {self._asking(part)}", "    won += s == 1", "    lost += s == 0"]
            lines += [f"    if won == {node.successes}:", "        return SUCCESS"]
            lines += [f"    if lost > {allowed}:", "        return FAILURE"]
        return [*lines, "    return RUNNING"]

    def _asking(self, node: Node) -> str:
        """A leaf is looked up; anything else gets a function, written later."""
        occurrence = self._occurrence
        if isinstance(node, Action | Condition):
            self._occurrence += 1
            return f"a[{occurrence}]"
        self._occurrence += len(leaves(node))
        name = f"part_{next(self._names)}"
        self.waiting.append((name, node, occurrence))
        return f"{name}(a)"

    def _expression(self, node: Node, nesting: int, *, strict: bool) -> str:
        if isinstance(node, Condition):
            return self._asking(node)
        if isinstance(node, Action | Parallel) or nesting == _MAX_NESTING:
            return f"(s := {self._asking(node)}) == 1" if strict else f"(s := {self._asking(node)})"
        if isinstance(node, Not):
            return f"(not {self._expression(node.child, nesting + 1, strict=not strict)})"
        return self._control(node, nesting + 1, strict=strict)

    def _control(self, node: Fallback | Sequence, nesting: int, *, strict: bool) -> str:
        """Children of a sequence are strict, of a fallback not; the last may be what the whole must be.

        Where that leaves open whether an action runs, what begins with the first action is followed by a look at `s`.
        """
        sequence = isinstance(node, Sequence)
        word = " and " if sequence else " or "
        *first, last = node.children
        parts = [self._expression(part, nesting, strict=sequence) for part in first]
        parts.append(self._expression(last, nesting, strict=strict))
        asking = sum(1 for _ in takewhile(_never_runs, first))
        if sequence is not strict and asking < len(first):
            look = " and s != 2" if strict else " or s == 2"
            parts[asking:] = [f"(({word.join(parts[asking:])}){look})"]
        return f"({word.join(parts)})"


def _never_runs(node: Node) -> bool:
    return not any(isinstance(inside, Action | Parallel) for inside in walk(node))
