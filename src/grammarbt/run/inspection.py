"""What happens to each node of a tree in a domain: how often it is visited, what it answers, what it is worth."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Literal

from attrs import frozen

from grammarbt.bt import (
    BehaviorTree,
    Node,
    Policy,
    Status,
    children,
    compile_policy,
    format_tree,
    node_statuses,
    numbered,
)
from grammarbt.domain import FIRST_VALIDATION_SCENARIO, Domain, Scenarios, Watchable, scenario_numbers
from grammarbt.errors import DomainError
from grammarbt.run.ablate import Ablator
from grammarbt.run.score import Validator
from grammarbt.run.simulate import simulate

if TYPE_CHECKING:
    from collections.abc import Iterator

_NORMAL_95 = 1.96
"""Standard errors to either side that make a 95 % interval of a mean, by the normal distribution."""


@frozen
class NodeCount:
    """What a node did, over all ticks.

    Attributes:
        place: of the node, in pre-order.
        visits: ticks that reached it.
        success, failure, running: how often it answered so; None when the domain cannot be watched.
    """

    place: int
    visits: int
    success: int | None = None
    failure: int | None = None
    running: int | None = None


@frozen
class Change:
    """What taking out a sub-tree does to the mean return.

    Attributes:
        place: of its root, in pre-order.
        subtree: in notation.
        change: mean over the scenarios of the return without it minus the return with it.
        low, high: 95 % interval of the change.
    """

    place: int
    subtree: str
    change: float
    low: float
    high: float


@frozen
class Inspection:
    """What was seen of a tree.

    Attributes:
        counted: `"ticks"` when every tick of a watchable domain was looked at, `"leaves"` when the domain only says how
            often each leaf was ticked; a control node is then visited as often as its first leaf.
        episodes: watched.
        nodes: in pre-order.
        ablation: of every sub-tree that can be taken out.
    """

    counted: Literal["ticks", "leaves"]
    episodes: int
    nodes: tuple[NodeCount, ...]
    ablation: tuple[Change, ...]

    @property
    def never(self) -> tuple[int, ...]:
        """Places of the nodes that no tick reached."""
        return tuple(node.place for node in self.nodes if node.visits == 0)

    @property
    def coverage(self) -> float:
        """Percentage of the nodes that some tick reached."""
        return 100 * (1 - len(self.never) / len(self.nodes))


def inspect_tree(tree: BehaviorTree, domain: Domain, seed: int, episodes: int) -> Inspection:
    """Look at a tree on the first validation scenarios of a seed.

    Raises:
        DomainError: the tree uses a leaf that the domain does not have, or the simulator fails.
    """
    policy = compile_policy(tree, domain.vocabulary.index)
    scenarios = scenario_numbers(seed, FIRST_VALIDATION_SCENARIO, FIRST_VALIDATION_SCENARIO + episodes)
    changes = _changes(tree, Ablator(Validator(domain, seed), episodes))
    if isinstance(domain, Watchable):
        return Inspection("ticks", episodes, _watched(policy, domain, scenarios), changes)
    return Inspection("leaves", episodes, _counted(policy, domain, scenarios), changes)


def subtrees(tree: BehaviorTree) -> Iterator[tuple[int, Node]]:
    """What can be taken out, with its place; an only child is not told from its parent."""
    nodes = numbered(tree)
    for place, (node, parent) in enumerate(nodes):
        if parent is not None and len(children(nodes[parent][0])) > 1:
            yield place, node


def _watched(policy: Policy, domain: Watchable, scenarios: Scenarios) -> tuple[NodeCount, ...]:
    """Counts from every tick; ticks in which the leaves answered alike are looked at once."""
    ticks: Counter[tuple[tuple[int, Status], ...]] = Counter()
    for scenario in scenarios:
        ticks.update(_answers(policy, domain, int(scenario)))
    answers: list[Counter[Status]] = [Counter() for _ in numbered(policy.tree)]
    for seen, times in ticks.items():
        for place, status in enumerate(node_statuses(policy.tree, dict(seen))):
            if status is not None:
                answers[place][status] += times
    return tuple(
        NodeCount(place, found.total(), found[Status.SUCCESS], found[Status.FAILURE], found[Status.RUNNING])
        for place, found in enumerate(answers)
    )


def _answers(policy: Policy, domain: Watchable, scenario: int) -> list[tuple[tuple[int, Status], ...]]:
    try:
        return [frame.answers for frame in domain.episode(policy, scenario).frames]
    except Exception as error:  # a simulator is foreign code: whatever it raises is the user's to hear
        raise DomainError(f"the domain cannot show an episode: {type(error).__name__}: {error}") from error


def _counted(policy: Policy, domain: Domain, scenarios: Scenarios) -> tuple[NodeCount, ...]:
    """Counts from the leaves alone: whatever reaches a control node ticks its first leaf."""
    simulation = simulate(domain, policy, scenarios)
    if simulation.status != "ok":
        raise DomainError(f"the domain cannot score the tree: {simulation.error}", "repair the domain")
    counts, occurrence = [], 0
    for place, (node, _) in enumerate(numbered(policy.tree)):
        counts.append(NodeCount(place, simulation.ticks[occurrence]))
        occurrence += not children(node)
    return tuple(counts)


def _changes(tree: BehaviorTree, ablator: Ablator) -> tuple[Change, ...]:
    found = []
    for place, node in subtrees(tree):
        drop = ablator.drop(tree, {place})
        spread = _NORMAL_95 * drop.stderr
        change = 0.0 - drop.mean
        found.append(Change(place, format_tree(node), change, change - spread, change + spread))
    return tuple(found)
