"""Drawing words, or derivations, of a language uniformly and exactly: draw a number, look up the word of that rank.

Ranks follow the graph's edges. A block's words have ranks of their own, so a rank of the whole splits, by division,
into a rank in the block and one in the rest.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from functools import cache, lru_cache
from itertools import accumulate
from typing import Literal, TypeAlias

import numpy as np

from grammarbt.grammar.automaton import Language
from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.count import totals
from grammarbt.grammar.leftmost import Word
from grammarbt.grammar.paths import Paths

Steps: TypeAlias = tuple[int, ...]
"""Terminals, or productions."""

Likely: TypeAlias = Literal["words", "derivations", "choices"]
"""What is drawn with equal chance: every tree, every derivation, or every choice on the way to a tree."""

REMEMBERED = 100_000
"""Sub-trees of each block kept once they have been spelled."""

_LARGEST_NATIVE = 2**63


class Ranking:
    """The words of a graph in order, by rank."""

    def __init__(self, graph: Paths, inside: Callable[[int], Ranking]) -> None:
        self._totals = totals(graph, lambda block: inside(block).total)
        self.total = self._totals[0]
        self.spelled = lru_cache(REMEMBERED)(self.unrank)
        self._rows = [self._row(graph, node, inside) for node in range(len(graph.edges))]

    def unrank(self, rank: int) -> Steps:
        """The word of a rank from 0 to `total` - 1."""
        found: Steps = ()
        node = 0
        while True:
            starts, edges = self._rows[node]
            at = bisect_right(starts, rank) - 1
            rank -= starts[at]
            node, steps, block = edges[at]
            if node < 0:
                return found
            if block is None:
                found += steps
            else:
                inner, rank = divmod(rank, self._totals[node])
                found += block.spelled(inner)

    def _row(
        self, graph: Paths, node: int, inside: Callable[[int], Ranking]
    ) -> tuple[list[int], list[tuple[int, Steps, Ranking | None]]]:
        """Where each edge's ranks begin, and what it spells; the end of the word, if possible here, comes first."""
        edges: list[tuple[int, Steps, Ranking | None]] = []
        sizes = []
        if graph.final[node]:
            edges.append((-1, (), None))
            sizes.append(1)
        for label, after in graph.edges[node]:
            block = inside(~label) if label < 0 else None
            edges.append((after, () if block else (label,), block))
            sizes.append(self._totals[after] * (block.total if block else 1))
        return [0, *accumulate(sizes[:-1])], edges


class Uniform:
    """Uniform draws from the language of a nonterminal.

    Args:
        language: the graphs of a bound grammar.
        symbol: a nonterminal; the start symbol unless given.
        derivations: draw derivations, so that an ambiguous word is as much likelier as it has derivations.

    Attributes:
        ranking: the words or derivations in order.
        total: how many there are.

    Raises:
        InfiniteLanguageError: there is no uniform distribution.
        TooLargeError: the language's graph passes the limits.
    """

    def __init__(self, language: Language, symbol: int | None = None, *, derivations: bool = False) -> None:
        graph_of = language.derivations if derivations else language.words

        @cache
        def ranking(block: int) -> Ranking:
            return Ranking(graph_of(block), ranking)

        self.ranking = ranking(language.bound.start_symbol if symbol is None else symbol)
        self.total = self.ranking.total

    def draw(self, rng: np.random.Generator, number: int) -> list[Steps]:
        """So many independent words (rows of terminals) or derivations."""
        unrank = self.ranking.unrank
        return [unrank(rank) for rank in draw_ranks(rng, self.total, number)]


def sampler(bound: BoundGrammar, likely: Likely) -> Callable[[np.random.Generator, int], list[Word]]:
    """Draws so many words at a time, of which all words, or all derivations, or all choices are equally likely.

    Choices go by the weights of the alternatives; this is for any language, also an infinite one.
    """
    if likely == "choices":
        walk, start = bound.leftmost.random_walk, bound.start()
        return lambda rng, number: [walk(start, rng)[1] for _ in range(number)]
    draw = Uniform(Language(bound), derivations=likely == "derivations").draw
    if likely == "words":
        return draw
    return lambda rng, number: [bound.derive(derivation).symbols for derivation in draw(rng, number)]


def draw_ranks(rng: np.random.Generator, total: int, number: int) -> list[int]:
    """Uniform numbers from 0 to `total` - 1, however large."""
    if total <= _LARGEST_NATIVE:
        found: list[int] = rng.integers(total, size=number, dtype=np.int64).tolist()
        return found
    return [_large_rank(rng, total) for _ in range(number)]


def _large_rank(rng: np.random.Generator, total: int) -> int:
    """By rejection: less than half of the draws are too large."""
    bits = total.bit_length()
    size = (bits + 7) // 8
    while True:
        rank = int.from_bytes(rng.bytes(size), "little") >> (8 * size - bits)
        if rank < total:
            return rank
