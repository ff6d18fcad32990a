"""From a tree to steps: which leaf is ticked, and where each of its answers leads.

Ticks are memoryless, so control nodes need no run time: compiling from right to left, what follows a leaf is known
before the leaf itself. Associativity, single children, double negation and De Morgan's laws disappear on the way.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

from attrs import frozen

from grammarbt.bt.model import Action, BehaviorTree, Condition, Fallback, Leaf, Node, Not, Parallel, Sequence
from grammarbt.errors import DomainError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

SUCCESS, FAILURE, RUNNING = -1, -2, -3
"""Ends of a tick, in the place of a next step."""

MAX_STEPS = 100_000

_RECENT = 256
"""Trees whose steps are kept: a tree is asked for its fingerprint, and, when its batch has been, for its policy."""

Step: TypeAlias = tuple[Leaf, int, int, int, int]
"""A leaf, its occurrence less the number of all leaves, and the steps that follow its success, failure and running."""


@frozen(eq=False)
class Steps:
    """A compiled tree.

    Attributes:
        steps: one for each leaf that a tick can reach and way of going on after it; each comes after all that it leads to.
        first: where a tick starts.
        occurrences: leaves of the tree.
    """

    steps: list[Step]
    first: int
    occurrences: int


@lru_cache(maxsize=_RECENT)
def compile_steps(tree: BehaviorTree) -> Steps:
    """Compile a tree.

    Raises:
        DomainError: it needs more than `MAX_STEPS` steps, as nested parallel nodes may.
    """
    compiler = _Compiler()
    first = compiler.compile(tree, SUCCESS, FAILURE, RUNNING)
    if len(compiler.steps) > MAX_STEPS:
        raise _too_many()
    steps = Steps(compiler.steps, first, -compiler.behind)
    return _reachable(steps) if compiler.copied else steps


def _too_many() -> DomainError:
    return DomainError(f"the tree's parallel nodes unroll to more than {MAX_STEPS:,} steps", "nest fewer of them")


def _reachable(steps: Steps) -> Steps:
    """Without what no tick reaches."""
    reached = {steps.first}
    for at in reversed(range(len(steps.steps))):
        if at in reached:
            reached.update(steps.steps[at][2:])
    kept: list[Step] = []
    new = {SUCCESS: SUCCESS, FAILURE: FAILURE, RUNNING: RUNNING}
    for at, (leaf, behind, *after) in enumerate(steps.steps):
        if at in reached:
            new[at] = len(kept)
            success, failure, running = (new[step] for step in after)
            kept.append((leaf, behind, success, failure, running))
    return Steps(kept, new[steps.first], steps.occurrences)


class _Compiler:
    """Walks a tree from right to left.

    Attributes:
        steps: so far.
        behind: minus the number of leaves from the present one to the tree's end.
        copied: whether there is a parallel node, of whose children copies are made.
    """

    def __init__(self) -> None:
        self.steps: list[Step] = []
        self.behind = 0
        self.copied = False
        self._copying = False
        self._known: dict[tuple[int, int, int, int], int] = {}
        self._unrolled: dict[tuple[int, int, int, int, int], tuple[int, int]] = {}

    def compile(self, node: Node, success: int, failure: int, running: int) -> int:
        """The step at which ticking `node` starts, when its answers lead to the given steps."""
        return self._WAYS[type(node)](self, node, success, failure, running)

    def _leaf(self, leaf: Leaf, success: int, failure: int, running: int) -> int:
        self.behind -= 1
        if self._copying:
            return self._copy(leaf, success, failure, running)
        self.steps.append((leaf, self.behind, success, failure, running))
        return len(self.steps) - 1

    def _copy(self, leaf: Leaf, success: int, failure: int, running: int) -> int:
        """Children of parallel nodes meet the same continuations again and again."""
        key = (self.behind, success, failure, running)
        at = self._known.get(key)
        if at is None:
            at = self._known[key] = len(self.steps)
            if at >= MAX_STEPS:  # at once: they could go on for ever
                raise _too_many()
            self.steps.append((leaf, *key))
        return at

    def _sequence(self, node: Sequence, success: int, failure: int, running: int) -> int:
        for child in reversed(node.children):
            success = self._WAYS[type(child)](self, child, success, failure, running)
        return success

    def _fallback(self, node: Fallback, success: int, failure: int, running: int) -> int:
        for child in reversed(node.children):
            failure = self._WAYS[type(child)](self, child, success, failure, running)
        return failure

    def _not(self, node: Not, success: int, failure: int, running: int) -> int:
        return self.compile(node.child, failure, success, running)

    def _parallel(self, node: Parallel, success: int, failure: int, running: int) -> int:
        """So do nested parallel nodes; each is unrolled once."""
        key = (id(node), self.behind, success, failure, running)  # the tree outlives the compiler, so ids stay
        if key not in self._unrolled:
            outside, self._copying, self.copied = self._copying, True, True
            start = self._unroll(node, success, failure, running)
            self._copying = outside
            self._unrolled[key] = (start, self.behind)
        start, self.behind = self._unrolled[key]
        return start

    def _unroll(self, node: Parallel, success: int, failure: int, running: int) -> int:
        """Unroll the counters: one copy of a child per (successes, failures) that it may find."""
        allowed = len(node.children) - node.successes
        after: dict[tuple[int, int], int] = {}

        def go_on(won: int, lost: int) -> int:
            if won == node.successes:
                return success
            return failure if lost > allowed else after.get((won, lost), running)

        for index in reversed(range(len(node.children))):
            behind, before = self.behind, {}
            for won in range(min(index + 1, node.successes)):
                for lost in range(min(index - won, allowed) + 1):
                    self.behind = behind
                    following = (go_on(won + 1, lost), go_on(won, lost + 1), go_on(won, lost))
                    before[won, lost] = self.compile(node.children[index], *following)
            after = before
        return after[0, 0]

    _WAYS: ClassVar[Mapping[type[Node], Callable[[_Compiler, Any, int, int, int], int]]] = {
        Action: _leaf,
        Condition: _leaf,
        Sequence: _sequence,
        Fallback: _fallback,
        Not: _not,
        Parallel: _parallel,
    }
