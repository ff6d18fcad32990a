"""Do two trees behave alike, and if not, what tells them apart?

Both trees are compiled into one decision graph. Where they start at the same node they behave alike; else a
breadth-first search through pairs of nodes finds the fewest answers after which they do something different.
"""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, TypeAlias

from attrs import frozen

from grammarbt.bt.bdd import DecisionGraph, TooLargeError
from grammarbt.bt.canonical import GraphBuilder, all_pure
from grammarbt.bt.compiler import FAILURE, RUNNING, SUCCESS
from grammarbt.bt.status import Status
from grammarbt.errors import DomainError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from grammarbt.bt.model import BehaviorTree, Condition

MAX_NODES = 200_000

_ENDS = {SUCCESS: "ends with success", FAILURE: "ends with failure", RUNNING: "ends running"}

Pair: TypeAlias = tuple[int, int]


@frozen
class Answer:
    """What a leaf said.

    Attributes:
        leaf: in notation.
        status: its answer.
    """

    leaf: str
    status: Status


@frozen
class Difference:
    """A shortest way to tell two trees apart within one tick.

    Attributes:
        answers: the answers of leaves that matter, in order; conditions between two actions hold together, and those
            not listed make no difference.
        one, other: what each tree does then, `ticks [report]` or `ends with success`.
    """

    answers: tuple[Answer, ...]
    one: str
    other: str


def difference(
    one: BehaviorTree, other: BehaviorTree, is_pure: Callable[[Condition], bool] = all_pure
) -> Difference | None:
    """A shortest scenario in which the trees differ; None when they behave alike.

    Args:
        one: a tree.
        other: the tree to compare it with.
        is_pure: whether a condition draws no randomness and changes only when an action runs.

    Raises:
        DomainError: the trees ask too many conditions, in too tangled an order, to be compared.
    """
    builder = GraphBuilder(is_pure, MAX_NODES)
    try:
        pair = (builder.start(one), builder.start(other))
    except TooLargeError:
        raise DomainError("the trees are too large to be compared exactly", "compare smaller sub-trees") from None
    return None if pair[0] == pair[1] else _search(builder.graph, pair)


def _search(graph: DecisionGraph, start: Pair) -> Difference:
    """Nodes are equal where behaviour is; so of unequal nodes some answers lead to an open difference."""
    came_from: dict[Pair, tuple[Pair, Answer] | None] = {start: None}
    queue = deque([start])
    while True:
        pair = queue.popleft()
        following = list(_following(graph, *pair))
        if not following:
            return Difference(_way(came_from, pair), _deed(graph, pair[0]), _deed(graph, pair[1]))
        for answer, reached in following:
            if reached[0] != reached[1] and reached not in came_from:
                came_from[reached] = (pair, answer)
                queue.append(reached)


def _following(graph: DecisionGraph, one: int, other: int) -> Iterator[tuple[Answer, Pair]]:
    """The next answers that both trees can be given, and where these lead; none when they do different things."""
    tests = [graph.tests[node] for node in (one, other) if node in graph.tests]
    leaf = min(tests) if tests else graph.nodes[one][0] if min(one, other) >= 0 else None
    if leaf is None or (not tests and graph.nodes[other][0] != leaf):
        return
    for column, status in enumerate((Status.SUCCESS, Status.FAILURE, Status.RUNNING)):
        if status is not Status.RUNNING or leaf.startswith("["):
            yield Answer(leaf, status), (_after(graph, one, leaf, column), _after(graph, other, leaf, column))


def _after(graph: DecisionGraph, node: int, leaf: str, column: int) -> int:
    """Where an answer leads; a node that does not ask this leaf stays."""
    return graph.nodes[node][1:][column] if node >= 0 and graph.nodes[node][0] == leaf else node


def _way(came_from: dict[Pair, tuple[Pair, Answer] | None], pair: Pair) -> tuple[Answer, ...]:
    answers = []
    while (step := came_from[pair]) is not None:
        pair, answer = step
        answers.append(answer)
    return tuple(reversed(answers))


def _deed(graph: DecisionGraph, node: int) -> str:
    return _ENDS[node] if node < 0 else f"ticks {graph.nodes[node][0]}"
