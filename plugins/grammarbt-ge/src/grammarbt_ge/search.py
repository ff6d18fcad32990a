"""The searcher: genomes that evolve."""

from __future__ import annotations

from grammarbt.grammar import Derivation, parse_tree
from grammarbt.search import BatchSearcher, Evolution, Scorer, SearchContext, States, pick
from grammarbt_ge.initialise import Initialiser
from grammarbt_ge.mapping import CODONS, Genome, Mapper
from grammarbt_ge.parameters import GeParameters


class GrammaticalEvolution(BatchSearcher):
    """Grammatical evolution (O'Neill & Ryan, "Grammatical Evolution", IEEE Trans. Evolutionary Computation 2001)."""

    def __init__(self, context: SearchContext, parameters: GeParameters) -> None:
        states = States(context.grammar)
        species = Genomes(context, parameters, states)
        super().__init__("ge", Evolution(species, Scorer(states), parameters, context.budget, context.rng))


class Genomes:
    """Lists of codons: bred by one-point crossover, or by exchange of whole lists, and by drawing codons anew."""

    def __init__(self, context: SearchContext, parameters: GeParameters, states: States) -> None:
        self.context = context
        self.parameters = parameters
        self.rng = context.rng
        self.mapper = Mapper(states, parameters.mapping, parameters.wraps)
        self.initialiser = Initialiser(states, parameters.depth, context.rng)

    def first(self, n: int) -> list[Genome]:
        """The start tree, if there is one, and as the parameters say."""
        start = self.context.start
        known = [] if start is None else [parse_tree(self.context.grammar, start)]
        made = self.initialiser.derivations(self.parameters.initialise, n - len(known))
        return [self.mapper.genome(derivation, self.rng) for derivation in known + made]

    def stranger(self) -> Genome:
        """The genome of a random tree."""
        return self.mapper.genome(self.context.grammar.sample(self.rng), self.rng)

    def derivation(self, genome: Genome) -> Derivation:
        """What the genome maps to."""
        return self.mapper.derivation(genome)

    def child(self, one: Genome, other: Genome) -> Genome:
        """Crossed over, then flipped."""
        if self.rng.random() < self.parameters.crossover:
            one = self._crossed(one, other)
        return tuple(map(self._flipped, one))

    def _crossed(self, one: Genome, other: Genome) -> Genome:
        if len(one) == 1:
            return ((*one[0][: self._cut(one[0])], *other[0][self._cut(other[0]) :]),)
        return tuple(pick(lists, self.rng) for lists in zip(one, other, strict=True))

    def _cut(self, codons: tuple[int, ...]) -> int:
        return int(self.rng.random() * (len(codons) + 1))

    def _flipped(self, codons: tuple[int, ...]) -> tuple[int, ...]:
        drawn = self.rng.random(len(codons)).tolist()
        flip = self.parameters.flip
        return tuple(
            int(self.rng.random() * CODONS) if chance < flip else codon
            for codon, chance in zip(codons, drawn, strict=True)
        )
