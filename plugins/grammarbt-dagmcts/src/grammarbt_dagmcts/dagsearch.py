"""The iterations that the published methods share: selection, expansion, roll-out and backup in a DAG."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from grammarbt.bt import BehaviorTree
from grammarbt.grammar import BoundGrammar, parse_tree
from grammarbt.search import Batches, Evaluation, Scenarios, SearchContext, make_bandit
from grammarbt_dagmcts.dag import ROOT, Dag, Tree
from grammarbt_dagmcts.draws import Draws
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
        self.draws = Draws(context.rng)
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
        self._roll_outs = RollOuts(self.dag, self.draws, self.longest)

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
        return [self._roll_outs.below(path, self.scenarios.fresh(1)) for path in paths if path is not None]

    def _select(self) -> tuple[int, ...] | None:
        """The edges from the root to a new node, or to a word; None when every word was proposed."""
        while not self.dag.closed[ROOT]:
            path = self._descend()
            if path is None:
                continue
            nodes = self._nodes(path)
            for node in nodes:
                self.dag.selections[node] += 1
            if self.dag.words[nodes[-1]]:
                self.dag.close(nodes[-1])
            return path
        return None

    def _nodes(self, path: tuple[int, ...]) -> list[int]:
        return [ROOT, *(self.dag.edges.child[edge] for edge in path)]

    def last(self, roll_out: RollOut) -> int:
        """The node that a roll-out begins at."""
        return self._nodes(roll_out.path)[-1]

    def _descend(self) -> tuple[int, ...] | None:
        """One way down; None if it ended at a node below which nothing is left, which is then closed."""
        path: list[int] = []
        node, nodes = ROOT, self.dag.texts
        while not self.dag.words[node]:
            known = len(nodes)
            edge = self._expand(node) or self._best_edge(node)
            if not edge:
                self.dag.close(node)
                return None
            path.append(edge)
            node = self.dag.edges.child[edge]
            if len(nodes) > known:
                break
        return tuple(path)

    def _expand(self, node: int) -> int:
        """The edge to an open child by a production that was not tried, drawn at random; 0 if there is none.

        The child is new unless another path led there.
        """
        while untried := self.dag.untried(node):
            place, production = self.dag.take_untried(node, self.draws.below(len(untried)))
            edge = self._after(node, place, production)
            child = self.dag.edges.child[edge]
            if not self.dag.closed[child] and not (self.only_unvisited and self.dag.rewards.visits[child]):
                return edge
        return 0

    def _after(self, parent: int, place: int, production: int) -> int:
        known = len(self.dag)
        edge = self.dag.after(parent, place, production)
        if self.link_new and len(self.dag) > known:
            self.link(self.dag.edges.child[edge])
        return edge

    def link(self, node: int) -> None:
        """Join a node to ancestors that no path led from, if the parameters want that."""
        if self.links:
            self.dag.link_ancestors(node, self.parameters.k, self.parameters.most_ancestors)

    def _best_edge(self, node: int) -> int:
        """The edge to the open child with the highest index; 0 if none is open.

        One without a reward comes first, ties are broken by a random number.
        """
        edges, children = self.dag.open_below(node)
        if not edges:
            return 0
        visits, selections = self.dag.rewards.visits, self.dag.selections
        if 0 in map(visits.__getitem__, children):
            return next(edge for edge, child in zip(edges, children, strict=True) if not visits[child])
        draw = self.draws.ready(len(children)).pop
        return edges[self.dag.rewards.most_urgent(children, self.bandit, (selections, draw), selections[node])]

    # Backup

    def learn(self, roll_out: RollOut, evaluation: Evaluation) -> float:
        """Give the reward to each ancestor once, whatever the number of paths; gives the reward."""
        reward = self.experience.learn(evaluation)
        self.bandit.observe(reward)
        self.dag.rewards.credit(self.dag.edges.ancestors(reversed(self._nodes(roll_out.path))), self.bandit, reward)
        return reward

    def begin_from(self, tree: BehaviorTree) -> Batches[None]:
        """Simulate a tree first; the forms of its derivation become nodes."""
        path: list[int] = []
        node = ROOT
        for production in parse_tree(self.grammar, tree):
            path.append(self._after(node, 0, production))
            node = self.dag.edges.child[path[-1]]
        self.dag.close(node)
        roll_out = self._roll_outs.below(tuple(path), self.scenarios.fresh(1))
        evaluations = yield [roll_out.proposal]
        self.learn(roll_out, evaluations[0])

    def metrics(self) -> Mapping[str, float]:
        """Size of the DAG and of the grammar."""
        return {
            "nodes": len(self.dag),
            "edges": len(self.dag.edges),
            "restarts": self.restarts,
            "macros": len(self.grammar.productions) - len(self.experience.grammar.productions),
        }
