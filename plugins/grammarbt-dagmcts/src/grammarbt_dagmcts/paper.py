"""The published method: Monte Carlo search over the derivation DAG, any order of expansion, from the start symbol.

Scheide, Best & Hollinger, "Behavior Tree Learning for Robotic Task Planning through Monte Carlo DAG Search over a Formal
Grammar" (2020). Where the paper is silent, the selection rule is that of the authors' later version (ICRA 2021).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

from attrs import frozen

from grammarbt.bt import BehaviorTree
from grammarbt.errors import SearcherError
from grammarbt.grammar import BoundGrammar, Derivation, SententialForm, parse_tree
from grammarbt.search import (
    Arm,
    Batches,
    Evaluation,
    HallOfFame,
    Proposal,
    Scenarios,
    SearchContext,
    Step,
    Width,
    block_derivations,
    leftmost,
    make_bandit,
    position_of,
)
from grammarbt_dagmcts.dag import Dag, Node, ancestors
from grammarbt_dagmcts.parameters import DagMctsParameters

LONGEST_ROLL_OUT = 2_000


@frozen(eq=False)
class RollOut:
    """A selected path, from the root to a node, and a random word below that node."""

    path: tuple[Node, ...]
    proposal: Proposal


class PaperSearch:
    """Selection, expansion, roll-out and backup in a DAG; restarts that turn good sub-trees into productions."""

    def __init__(self, context: SearchContext, parameters: DagMctsParameters) -> None:
        self.base = self.grammar = context.grammar
        self.parameters = parameters
        self.rng = context.rng
        self.scenarios = Scenarios()
        self.fame = HallOfFame()
        self.subtrees: dict[tuple[int, Derivation], Arm] = {}
        self.episodes = self.restarts = 0
        self.worst = 0.0
        self.start = context.start
        self._begin(self.base)

    def _begin(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self.dag = Dag(grammar)
        self.bandit = make_bandit(self.parameters.bandit, 1.0 if self.parameters.c is None else self.parameters.c)

    def batches(self, width: Width) -> Batches[None]:
        """One roll-out on one fresh scenario per proposal; the first is the start tree, if there is one."""
        if self.start is not None:
            first = self._along(parse_tree(self.base, self.start))
            evaluations = yield [first.proposal]
            self._learn(first, evaluations[0])
        while True:
            planned = [self._roll_out(path) for _ in range(width()) if (path := self._select())]
            if not planned:
                return
            evaluations = yield [roll_out.proposal for roll_out in planned]
            for roll_out, evaluation in zip(planned, evaluations, strict=True):
                self._learn(roll_out, evaluation)
            self._restart_when_due(len(planned))

    # Selection and expansion

    def _select(self) -> tuple[Node, ...]:
        """From the root to a new node, or to a word; empty when every word was proposed."""
        while not self.dag.root.closed:
            path = self._descend()
            if not path:
                continue
            for node in path:
                node.selections += 1
            if self.grammar.is_word(path[-1].form):
                self.dag.close(path[-1])
            return path
        return ()

    def _descend(self) -> tuple[Node, ...]:
        """One way down; empty if it ended at a node below which nothing is left, which is then closed."""
        path = [self.dag.root]
        while not self.grammar.is_word(path[-1].form):
            known = len(self.dag.nodes)
            child = self._expand(path[-1]) or self._best_child(path[-1])
            if child is None:
                self.dag.close(path[-1])
                return ()
            path.append(child)
            if len(self.dag.nodes) > known:
                break
        return tuple(path)

    def _expand(self, node: Node) -> Node | None:
        """An open child by a production that was not tried, drawn at random; new unless another path led there."""
        if node.untried is None:
            positions = self.grammar.positions(node.form)
            node.untried = [(at, production) for at in positions for production in self.grammar.legal(node.form, at)]
        while node.untried:
            drawn = int(self.rng.integers(len(node.untried)))
            node.untried[drawn], node.untried[-1] = node.untried[-1], node.untried[drawn]
            position, production = node.untried.pop()
            child = self._child(self.grammar.apply(node.form, production, position))
            if not child.closed:
                return child
        return None

    def _child(self, form: SententialForm) -> Node:
        known = self.dag.nodes.get(form)
        if known is not None:
            return known
        node = self.dag.add(form)
        if self.parameters.ancestor_links:
            self.dag.link_ancestors(node, self.parameters.k, self.parameters.most_ancestors)
        return node

    def _best_child(self, node: Node) -> Node | None:
        """The child with the highest index; one without a reward comes first, ties are broken by a random number."""
        best, highest = None, float("-inf")
        for child, _ in node.children.values():
            if child.closed:
                continue
            noise = float(self.rng.random())
            index = float("inf")
            if child.visits:
                index = self.bandit.index(child, child.selections + noise + 1e-9, node.selections)
            if best is None or index > highest:
                best, highest = child, index
        return best

    # Roll-out

    def _along(self, derivation: Derivation) -> RollOut:
        """A whole derivation, whose forms become nodes."""
        path = [self.dag.root]
        for production in derivation:
            path.append(self._child(self.grammar.apply(path[-1].form, production)))
        self.dag.close(path[-1])
        start = self.scenarios.fresh(1)
        return RollOut(tuple(path), Proposal(self.grammar.tree(path[-1].form), derivation, start, start + 1))

    def _roll_out(self, path: tuple[Node, ...]) -> RollOut:
        steps: list[Step] = []
        for parent, child in pairwise(path):
            production = parent.children[child.number][1]
            steps.append((parent.form, position_of(self.grammar, parent.form, production, child.form), production))
        form = path[-1].form
        while not self.grammar.is_word(form):
            production = self._random_production(form)
            steps.append((form, self.grammar.positions(form)[0], production))
            form = self.grammar.apply(form, production)
            if len(steps) > LONGEST_ROLL_OUT:
                message = f"a random derivation took more than {LONGEST_ROLL_OUT:,} productions"
                raise SearcherError(message, "lower the weights of recursive alternatives, or add %limit")
        derivation = tuple(production for production in leftmost(self.grammar, steps) if production is not None)
        start = self.scenarios.fresh(1)
        base = self.grammar.base_derivation(derivation)
        return RollOut(path, Proposal(self.grammar.tree(form), base, start, start + 1))

    def _random_production(self, form: SententialForm) -> int:
        legal = self.grammar.legal(form)
        weights = [self.grammar.productions[production].weight for production in legal]
        drawn = float(self.rng.random()) * sum(weights)
        for production, weight in zip(legal, weights, strict=True):
            drawn -= weight
            if drawn < 0.0:
                return production
        return legal[-1]

    # Backup and restarts

    def _learn(self, roll_out: RollOut, evaluation: Evaluation) -> None:
        """Give the reward to each ancestor once, whatever the number of paths."""
        self.episodes += 1
        if evaluation.returns:
            self.worst = min(self.worst, evaluation.mean)
        reward = evaluation.mean if evaluation.returns else self.worst
        self.fame.observed.add(reward)
        self.fame.add(evaluation.proposal.tree, evaluation.returns)
        for unit in dict.fromkeys(block_derivations(self.base, evaluation.proposal.derivation or ())):
            self.subtrees.setdefault(unit, Arm()).add(reward)
        self.bandit.observe(reward)
        for node in ancestors(roll_out.path):
            self.bandit.credit(node, reward)

    def _restart_when_due(self, done: int) -> None:
        every = self.parameters.restart_every
        if every and self.episodes // every > (self.episodes - done) // every:
            self.restarts += 1
            self._begin(self._extended())

    def _extended(self) -> BoundGrammar:
        """The base grammar with the most promising sub-trees as productions."""
        grammar = self.base
        chosen = self._promising(self.parameters.macros)
        for block in dict.fromkeys(block for block, _ in chosen):
            grammar = grammar.extended(block, [derivation for other, derivation in chosen if other == block])
        return grammar

    def _promising(self, n: int) -> Sequence[tuple[int, Derivation]]:
        """The n sub-trees with the best mean return of the trees they were in, less one standard error."""
        deviation = self.fame.observed.variance**0.5 if self.subtrees else 0.0
        ranked = sorted(self.subtrees.items(), key=lambda item: deviation / item[1].visits ** 0.5 - item[1].mean)
        return [unit for unit, _ in ranked[:n]]

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The trees with the best returns."""
        return self.fame.best(n)

    def metrics(self) -> Mapping[str, float]:
        """Size of the DAG and of the grammar."""
        return {
            "nodes": len(self.dag.nodes),
            "edges": self.dag.edges,
            "restarts": self.restarts,
            "macros": len(self.grammar.productions) - len(self.base.productions),
        }
