"""New genomes from old ones."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence

import numpy as np

from grammarbt.search import end_of, pick
from grammarbt_ge.mapping import CODONS, Genome, Mapper, ReadCodon, Reading


class Breeder:
    """Changes what is read of genomes.

    Args:
        mapper: reads the children.
        rng: chance.
    """

    def __init__(self, mapper: Mapper, rng: np.random.Generator) -> None:
        self.mapper = mapper
        self.grammar = mapper.states.grammar
        self.rng = rng

    def crossed(self, one: Reading, other: Reading) -> Reading:
        """A head of the one and a tail of the other; of several lists, each from either parent."""
        pairs = zip(self._lists(one.codons), self._lists(other.codons), strict=True)
        if self.mapper.lists == 1:
            return self.mapper.read(tuple(own[: self._cut(own)] + new[self._cut(new) :] for own, new in pairs))
        return self.mapper.read(tuple(pick(pair, self.rng) for pair in pairs))

    def _cut(self, codons: tuple[int, ...]) -> int:
        return pick(range(len(codons) + 1), self.rng)

    def matched(self, one: Reading, other: Reading) -> Reading:
        """The codons of a sub-tree of the one replaced by those of the other's sub-tree of the same nonterminal.

        After Harper & Blair, "A Structure Preserving Crossover in Grammatical Evolution", CEC 2005.
        """
        if not one.codons:
            return one
        at = pick(range(len(one.codons)), self.rng)
        symbol = self._symbol(one, at)
        alike = [place for place in range(len(other.codons)) if self._symbol(other, place) == symbol]
        if not alike:
            return one
        place = pick(alike, self.rng)
        part = other.codons[place : self._end(other, place)]
        return self._read([*one.codons[:at], *part, *one.codons[self._end(one, at) :]])

    def _symbol(self, genome: Reading, at: int) -> int:
        """The nonterminal for which a codon was read."""
        return self.grammar.productions[genome.derivation[genome.codons[at][0]]].lhs

    def _end(self, genome: Reading, at: int) -> int:
        """Where the codons end that were read for the sub-tree that begins with one of them."""
        end = end_of(self.grammar.growth, genome.derivation, genome.codons[at][0])
        return bisect_left(genome.codons, (end,))

    def flipped(self, one: Reading) -> Reading:
        """One codon drawn anew."""
        if not one.codons:
            return one
        at = pick(range(len(one.codons)), self.rng)
        step, gene, _ = one.codons[at]
        return self._read([*one.codons[:at], (step, gene, int(self.rng.random() * CODONS)), *one.codons[at + 1 :]])

    def _read(self, codons: Sequence[ReadCodon]) -> Reading:
        return self.mapper.read(self._lists(codons))

    def _lists(self, codons: Sequence[ReadCodon]) -> Genome:
        """Codons, each in the list that it is from."""
        lists: list[list[int]] = [[] for _ in range(self.mapper.lists)]
        for _, gene, codon in codons:
            lists[gene].append(codon)
        return tuple(map(tuple, lists))
