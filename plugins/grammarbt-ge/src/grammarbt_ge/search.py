"""The searcher: genomes that evolve."""

from __future__ import annotations

from grammarbt.grammar import Derivation, parse_tree
from grammarbt.search import BatchSearcher, Evolution, Scorer, SearchContext, States
from grammarbt_ge.breeding import Breeder
from grammarbt_ge.initialise import Initialiser
from grammarbt_ge.mapping import Mapper, Reading
from grammarbt_ge.parameters import GeParameters


class GrammaticalEvolution(BatchSearcher):
    """Grammatical evolution (O'Neill & Ryan, "Grammatical Evolution", IEEE Trans. Evolutionary Computation 2001)."""

    def __init__(self, context: SearchContext, parameters: GeParameters) -> None:
        states = States(context.grammar)
        species = Genomes(context, parameters, states)
        super().__init__("ge", Evolution(species, Scorer(states), parameters, context.budget, context.rng))


class Genomes:
    """Genomes as they are read: codons that no choice needs are not passed on."""

    def __init__(self, context: SearchContext, parameters: GeParameters, states: States) -> None:
        self.context = context
        self.parameters = parameters
        self.rng = context.rng
        self.states = states
        self.mapper = Mapper(states, parameters.mapping, parameters.wraps)
        self.breeder = Breeder(self.mapper, context.rng)
        self.initialiser = Initialiser(states, parameters.depth, context.rng)

    def first(self, n: int) -> list[Reading]:
        """The start tree, if there is one, and as the parameters say."""
        start = self.context.start
        known = [] if start is None else [parse_tree(self.context.grammar, start)]
        made = self.initialiser.derivations(self.parameters.initialise, n - len(known))
        return [self._reading(derivation) for derivation in known + made]

    def stranger(self) -> Reading:
        """The genome of a random tree."""
        walk = self.states.walk()
        walk.grow(self.rng)
        return self._reading(tuple(walk.derivation))

    def _reading(self, derivation: Derivation) -> Reading:
        return self.mapper.read(self.mapper.genome(derivation, self.rng))

    def derivation(self, genome: Reading) -> Derivation:
        """What the genome maps to."""
        return genome.derivation

    def child(self, one: Reading, other: Reading) -> Reading:
        """Bred from both; or from one alone, a codon drawn anew, or all that belong to a sub-tree."""
        if self.rng.random() < self.parameters.crossover:
            if self.rng.random() < self.parameters.matching:
                return self.breeder.matched(one, other)
            return self.breeder.crossed(one, other)
        if self.rng.random() < self.parameters.regrow:
            return self.breeder.matched(one, self.stranger())
        return self.breeder.flipped(one)
