"""The searcher: a tree of leftmost derivations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from attrs import define, field

from grammarbt.bt import BehaviorTree
from grammarbt.grammar import Derivation, parse_tree
from grammarbt.search import (
    Arm,
    Batches,
    BatchSearcher,
    Scorer,
    SearchContext,
    States,
    Walk,
    Width,
    make_bandit,
    pick,
)
from grammarbt_uct.parameters import UctParameters


class Uct(BatchSearcher):
    """UCT (Kocsis & Szepesvári, "Bandit Based Monte-Carlo Planning", ECML 2006) over leftmost derivations."""

    def __init__(self, context: SearchContext, parameters: UctParameters) -> None:
        super().__init__("uct", DerivationTreeSearch(context, parameters))


@define(eq=False)
class Node(Arm):
    """A derivation up to a choice.

    Attributes:
        children: by production.
        choices: how many productions are legal; 0 where there is no choice.
        pulls: how often it was selected, which is more than its rewards while some are awaited.
        closed: every word below it was proposed.
    """

    children: dict[int, Node] = field(factory=dict, init=False, repr=False)
    choices: int = field(default=0, init=False)
    pulls: int = field(default=0, init=False)
    closed: bool = field(default=False, init=False)


class DerivationTreeSearch:
    """Selection, expansion by one node, roll-out by weight, backup of the return."""

    def __init__(self, context: SearchContext, parameters: UctParameters) -> None:
        self.rng = context.rng
        self.states = States(context.grammar)
        self.scorer = Scorer(self.states)
        self.bandit = make_bandit(parameters.bandit, parameters.c)
        self.root = Node()
        self.nodes = 1
        self.start = None if context.start is None else parse_tree(context.grammar, context.start)

    def batches(self, width: Width) -> Batches[None]:
        """As many roll-outs at a time as the run can use; ends when every word was proposed."""
        if self.start is not None:
            yield from self._simulate([((self.root,), self.start)])
        while not self.root.closed:
            planned: list[tuple[Sequence[Node], Derivation]] = []
            while len(planned) < width() and not self.root.closed:
                planned.append(self._roll_out())
            yield from self._simulate(planned)

    def _roll_out(self) -> tuple[tuple[Node, ...], Derivation]:
        """The nodes selected, the last of them new, and a random word below."""
        walk, path = self.states.walk(), [self.root]
        _skip_forced(walk)
        while walk.state is not None:
            node, state = path[-1], walk.state
            node.choices = len(state.productions)
            untried = [production for production in state.productions if production not in node.children]
            production = pick(untried, self.rng) if untried else self._best(node)
            path.append(self._child(node, production))
            walk.take(production)
            _skip_forced(walk)
            if untried:
                break
        if walk.state is None:
            _close(path)
        walk.grow(self.rng)
        for node in path:
            node.pulls += 1
        return tuple(path), tuple(walk.derivation)

    def _child(self, node: Node, production: int) -> Node:
        child = node.children.get(production)
        if child is None:
            child = node.children[production] = Node()
            self.nodes += 1
        return child

    def _best(self, node: Node) -> int:
        """The most urgent child that is not closed; one whose first reward is awaited comes last."""
        best, highest = -1, float("-inf")
        for production, child in node.children.items():
            index = self.bandit.index(child, child.pulls, node.pulls) if child.visits else float("-inf")
            if not child.closed and (best < 0 or index > highest):
                best, highest = production, index
        return best

    def _simulate(self, planned: Sequence[tuple[Sequence[Node], Derivation]]) -> Batches[None]:
        scores = yield from self.scorer.score([derivation for _, derivation in planned])
        for (path, _), score in zip(planned, scores, strict=True):
            reward = self.scorer.reward(score)
            self.bandit.observe(reward)
            for node in path:
                self.bandit.credit(node, reward)

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The trees that are best for sure."""
        return self.scorer.best(n)

    def metrics(self) -> Mapping[str, float]:
        """Size of the tree, and whether the language is finished."""
        return {"nodes": self.nodes, "derivations": len(self.scorer.scores), "finished": float(self.root.closed)}


def _skip_forced(walk: Walk) -> None:
    while walk.state is not None and len(walk.state.productions) == 1:
        walk.take(walk.state.productions[0])


def _close(path: Sequence[Node]) -> None:
    """Close the last node, and each before it all of whose children are closed."""
    for node in reversed(path):
        if len(node.children) < node.choices or not all(child.closed for child in node.children.values()):
            return
        node.closed = True
