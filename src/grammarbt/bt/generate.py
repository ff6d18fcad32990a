"""Python source of a tick, for simulations that are long enough to pay for compiling it.

A tree becomes one expression of `and`, `or` and `not`, whose jumps Python compiles itself. Only numbers stand in it,
never a leaf's name. `s` is the answer of the last action; when it is running, nothing more is asked. An expression is
true either on success alone (*strictly*, as `and` needs it) or on success and running (as `or` needs it).
"""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, Any

from grammarbt.bt.model import Action, BehaviorTree, Condition, Fallback, Node, Not, Parallel, Sequence, walk
from grammarbt.bt.status import Status
from grammarbt.errors import DomainError

if TYPE_CHECKING:
    from grammarbt.bt.linked import Ticker

_MAX_NESTING = 60
"""Control nodes in one expression; Python's own reader gives up at 200 nested parentheses."""


def compile_source(tree: BehaviorTree) -> Ticker:
    """A function that ticks the tree once and gives the root's status, from generated source."""
    names: dict[str, Any] = {status.name: status for status in Status}
    exec(compile(generate_source(tree), "<behavior tree>", "exec"), names)  # noqa: S102 – nothing but numbers enters
    ticker: Ticker = names["tick"]
    return ticker


def generate_source(tree: BehaviorTree) -> str:
    """Source of a function `tick(a)`, where `a[i]` is asked when the leaf of occurrence i is ticked.

    Raises:
        DomainError: parallel nodes are nested nearly as deep as trees may be.
    """
    writer = _Writer()
    try:
        writer.function("tick", tree)
    except RecursionError:
        raise DomainError("the tree's parallel nodes are nested too deeply", "tick its flat form") from None
    return "\n".join(writer.lines) + "\n"


class _Writer:
    """Writes the tree's function, and before it those of parallel nodes and of what is nested too deeply."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.occurrences = count()
        self.functions = count(1)

    def function(self, name: str, tree: Node) -> None:
        expression = self.expression(tree, 0, strict=False)
        self.lines += [f"def {name}(a):", "    s = 0", f"    if {expression}:"]
        self.lines += ["        return RUNNING if s == 2 else SUCCESS", "    return FAILURE"]

    def expression(self, node: Node, nesting: int, *, strict: bool) -> str:
        if isinstance(node, Condition):
            return f"a[{next(self.occurrences)}]"
        if isinstance(node, Action):
            return _acting(f"a[{next(self.occurrences)}]", strict=strict)
        if isinstance(node, Parallel):
            return _acting(f"{self.parallel(node)}(a)", strict=strict)
        if nesting == _MAX_NESTING:
            return _acting(f"{self.separate(node)}(a)", strict=strict)
        if isinstance(node, Not):
            return f"(not {self.expression(node.child, nesting + 1, strict=not strict)})"
        return self.control(node, nesting, strict=strict)

    def control(self, node: Fallback | Sequence, nesting: int, *, strict: bool) -> str:
        """Children of a sequence are strict, of a fallback not; the last may be what the whole must be."""
        sequence = isinstance(node, Sequence)
        *first, last = node.children
        parts = [self.expression(part, nesting + 1, strict=sequence) for part in first]
        parts.append(self.expression(last, nesting + 1, strict=strict))
        joined = f"({(' and ' if sequence else ' or ').join(parts)})"
        if sequence is strict or not any(map(_may_run, first)):
            return joined
        return f"({joined} and s != 2)" if strict else f"({joined} or s == 2)"

    def separate(self, node: Node) -> str:
        name = f"part_{next(self.functions)}"
        self.function(name, node)
        return name

    def parallel(self, node: Parallel) -> str:
        name = f"parallel_{next(self.functions)}"
        parts = [self.separate(part) for part in node.children]
        lines = [f"def {name}(a):", "    won = lost = 0"]
        for part in parts:
            lines += [f"    s = {part}(a)", "    won += s == 1", "    lost += s == 0"]
            lines += [f"    if won == {node.successes}:", "        return SUCCESS"]
            lines += [f"    if lost > {len(parts) - node.successes}:", "        return FAILURE"]
        self.lines += [*lines, "    return RUNNING"]
        return name


def _acting(call: str, *, strict: bool) -> str:
    return f"(s := {call}) == 1" if strict else f"(s := {call})"


def _may_run(node: Node) -> bool:
    return any(isinstance(inside, Action | Parallel) for inside in walk(node))
