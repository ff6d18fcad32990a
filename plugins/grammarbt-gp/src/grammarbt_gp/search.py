"""The searcher: derivation trees that evolve."""

from __future__ import annotations

from itertools import islice

from grammarbt.grammar import Derivation, parse_tree
from grammarbt.search import (
    BatchSearcher,
    DerivationTree,
    Evolution,
    IdleElements,
    Moves,
    Scorer,
    SearchContext,
    States,
    pick,
    smallest_first,
)
from grammarbt_gp.parameters import GpParameters


class GeneticProgramming(BatchSearcher):
    """Genetic programming on derivation trees, so that every child is in the language (Whigham 1995).

    The greedy start and the removal of what never acts are those of Colledanchise, Parasuraman & Ögren, "Learning of
    Behavior Trees for Autonomous Agents", IEEE Trans. Games 2019.
    """

    def __init__(self, context: SearchContext, parameters: GpParameters) -> None:
        states = States(context.grammar)
        scorer = Scorer(states)
        trees = Trees(context, parameters, states, scorer)
        super().__init__("gp", Evolution(trees, scorer, parameters, context.budget, context.rng))


class Trees:
    """Derivations: bred by exchange of sub-trees, or by one of the moves."""

    def __init__(self, context: SearchContext, parameters: GpParameters, states: States, scorer: Scorer) -> None:
        self.context = context
        self.parameters = parameters
        self.rng = context.rng
        self.scorer = scorer
        self.moves = Moves(context.grammar, states)
        self.idle = IdleElements(self.moves)
        self.mutations = (self.moves.regenerate, self.moves.insert, self.moves.delete, self.moves.reorder)

    def first(self, n: int) -> list[Derivation]:
        """The start tree, if there is one, and random ones; the smallest trees too, but once."""
        start = self.context.start
        known = [] if start is None else [parse_tree(self.context.grammar, start)]
        greedy = 0.0 if self.scorer.scores else self.parameters.greedy
        small = list(islice(smallest_first(self.moves.states), int(greedy * self.context.budget)))
        return [*known, *small, *(self.stranger() for _ in range(n - len(known) - len(small)))]

    def stranger(self) -> Derivation:
        """A random tree."""
        return self.context.grammar.sample(self.rng)

    def derivation(self, genome: Derivation) -> Derivation:
        """The genome is the derivation."""
        return genome

    def child(self, one: Derivation, other: Derivation) -> Derivation:
        """Crossed over, or mutated; a parent itself if there is no way to do so within the language."""
        tree = self.trimmed(one)
        if self.rng.random() < self.parameters.crossover:
            return self.moves.cross(tree, self.trimmed(other), self.rng) or one
        return pick(self.mutations, self.rng)(tree, self.rng) or one

    def trimmed(self, derivation: Derivation) -> DerivationTree:
        """The derivation's tree, without what is known to be idle."""
        tree = self.moves.tree(derivation)
        known = self.scorer.scores.get(derivation)
        if not (self.parameters.trim and known and known.ticks):
            return tree
        return self.idle.removed(tree, known.ticks, self.rng)
