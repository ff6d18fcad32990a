"""The iterations that the published methods share: selection, expansion, roll-out and backup in a DAG."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from grammarbt.bt import BehaviorTree
from grammarbt.grammar import BoundGrammar, parse_tree
from grammarbt.search import Batches, Evaluation, Proposal, Scenarios, SearchContext, make_bandit
from grammarbt_dagmcts.dag import Dag, Node, Tree, ancestors
from grammarbt_dagmcts.experience import Experience
from grammarbt_dagmcts.parameters import DagMctsParameters
from grammarbt_dagmcts.rollout import RollOut, RollOuts
from grammarbt_dagmcts.trace import file_of_restart, write_graphml


class DagSearch:
    """Any order of expansion, from the start symbol; restarts turn good sub-trees into productions.

    Args:
        context: what to search.
        parameters: how.
        longest: random productions of a roll-out unless the parameters say.
        link_new: whether each new node is joined to its ancestors at once.
        only_unvisited: whether an untried production counts as tried when the form after it has a reward.
    """

    def __init__(
        self,
        context: SearchContext,
        parameters: DagMctsParameters,
        *,
        longest: int,
        link_new: bool,
        only_unvisited: bool,
    ) -> None:
        self.parameters = parameters
        self.rng = context.rng
        self.links = parameters.dag and parameters.ancestor_links
        self.link_new = link_new
        self.only_unvisited = only_unvisited
        self.longest = longest if parameters.roll_out is None else parameters.roll_out
        self.scenarios = Scenarios()
        self.experience = Experience(context.grammar)
        self.restarts = 0
        self._begin(context.grammar)

    def _begin(self, grammar: BoundGrammar) -> None:
        self.grammar = grammar
        self.dag = Dag(grammar) if self.parameters.dag else Tree(grammar)
        self.bandit = make_bandit(self.parameters.bandit, 1.0 if self.parameters.c is None else self.parameters.c)
        self._roll_outs = RollOuts(grammar, self.rng, self.longest)

    def restart(self) -> None:
        """Begin a new DAG, with the most promising sub-trees as productions."""
        self.restarts += 1
        if self.parameters.trace is not None:
            write_graphml(file_of_restart(Path(self.parameters.trace), self.restarts), self.grammar, [self.dag])
        self._begin(self.experience.extended(self.parameters.macros))

    # Selection and expansion

    def plan(self, n: int) -> list[RollOut]:
        """At most n roll-outs, each on a scenario of its own; none when every word was proposed."""
        paths = (self._select() for _ in range(n))
        return [self._roll_outs.below(path, self.scenarios.fresh(1)) for path in paths if path]

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
            child = self._child(node, production, position)
            if not child.closed and not (self.only_unvisited and child.visits):
                return child
        return None

    def _child(self, parent: Node, production: int, position: int | None = None) -> Node:
        known = len(self.dag.nodes)
        child = self.dag.child(parent, production, position)
        if self.link_new and len(self.dag.nodes) > known:
            self.link(child)
        return child

    def link(self, node: Node) -> None:
        """Join a node to ancestors that no path led from, if the parameters want that."""
        if self.links:
            self.dag.link_ancestors(node, self.parameters.k, self.parameters.most_ancestors)

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

    # Backup

    def learn(self, roll_out: RollOut, evaluation: Evaluation) -> float:
        """Give the reward to each ancestor once, whatever the number of paths; gives the reward."""
        reward = self.experience.learn(evaluation)
        self.bandit.observe(reward)
        for node in ancestors(roll_out.path):
            self.bandit.credit(node, reward)
        return reward

    def begin_from(self, tree: BehaviorTree) -> Batches[None]:
        """Simulate a tree first; the forms of its derivation become nodes."""
        derivation = parse_tree(self.grammar, tree)
        path = [self.dag.root]
        for production in derivation:
            path.append(self._child(path[-1], production))
        self.dag.close(path[-1])
        start = self.scenarios.fresh(1)
        proposal = Proposal(self.grammar.tree(path[-1].form), derivation, start, start + 1)
        evaluations = yield [proposal]
        self.learn(RollOut(tuple(path), proposal), evaluations[0])

    def metrics(self) -> Mapping[str, float]:
        """Size of the DAG and of the grammar."""
        return {
            "nodes": len(self.dag.nodes),
            "edges": self.dag.edges,
            "restarts": self.restarts,
            "macros": len(self.grammar.productions) - len(self.experience.grammar.productions),
        }
