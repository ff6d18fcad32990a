"""How large a language is: derivations, distinct words and behaviours, all exact."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache

from attrs import frozen

from grammarbt.bt.canonical import canonical_key
from grammarbt.grammar.automaton import Language
from grammarbt.grammar.leftmost import Word
from grammarbt.grammar.paths import InfiniteLanguageError, Paths, TooLargeError

MAX_LISTED = 200_000
"""Words up to which behaviours are counted; that takes listing them."""


@frozen
class Count:
    """The size of a language.

    Attributes:
        derivations, words: how many; None when the language is too large to tell.
        behaviours: how many of the words differ in canonical form; None when there are too many to list.
    """

    derivations: int | None
    words: int | None
    behaviours: int | None


class Counter:
    """Counts what can be derived from nonterminals; infinite languages raise `InfiniteLanguageError`."""

    def __init__(self, language: Language) -> None:
        self.language = language
        self.words = cache(self._words)
        self.derivations = cache(self._derivations)

    def count(self, symbol: int) -> Count:
        """Everything about one nonterminal, as far as it can be told within the limits."""
        words = _within_limits(self.words, symbol)
        derivations = _within_limits(self.derivations, symbol)
        listed = words is not None and words <= MAX_LISTED
        return Count(derivations, words, _within_limits(self.behaviours, symbol) if listed else None)

    def groups(self) -> dict[str, Count]:
        """One entry per group: what its block derives by itself; the block's name where a group has several."""
        bound = self.language.bound
        found: dict[str, Count] = {}
        for group in bound.vocabulary.groups if bound.blocks else ():
            own = [block for block in bound.blocks if bound.nonterminal_name(block).endswith(f"{{{group.name}}}")]
            if not own:
                found[group.name] = Count(0, 0, 0)
            for block in own:
                name = group.name if len(own) == 1 else bound.nonterminal_name(block)
                found[name] = self._part(block)
        return found

    def _part(self, block: int) -> Count:
        """A block's size; it may have no end of its own where only the whole tree is limited."""
        try:
            return self.count(block)
        except InfiniteLanguageError:
            return Count(None, None, None)

    def behaviours(self, symbol: int) -> int:
        """Distinct canonical forms among the words, by listing them all."""
        bound = self.language.bound
        words, is_pure = distinct_words(self.language, symbol), bound.vocabulary.is_pure
        return len({canonical_key(bound.tree_of(word), is_pure) for word in words})

    def _words(self, symbol: int) -> int:
        return totals(self.language.words_to_count(symbol), self.words)[0]

    def _derivations(self, symbol: int) -> int:
        return totals(self.language.derivations_to_count(symbol), self.derivations)[0]


def totals(graph: Paths, inside: Callable[[int], int]) -> list[int]:
    """How many paths lead from each node to an end, where an edge that is a block counts as often as it has words."""
    found = [0] * len(graph.edges)
    for node in graph.order:
        ways = (found[after] if label >= 0 else inside(~label) * found[after] for label, after in graph.edges[node])
        found[node] = graph.final[node] + sum(ways)
    return found


def distinct_words(language: Language, symbol: int) -> Iterator[Word]:
    """Each word of a nonterminal once, in the order of the graph's edges."""
    graph = language.words(symbol)
    stack: list[tuple[int, Word]] = [(0, ())]
    while stack:
        node, word = stack.pop()
        if graph.final[node]:
            yield word
        for label, after in reversed(graph.edges[node]):
            parts = [(label,)] if label >= 0 else list(distinct_words(language, ~label))
            stack += [(after, word + part) for part in reversed(parts)]


def _within_limits(counted: Callable[[int], int], symbol: int) -> int | None:
    try:
        return counted(symbol)
    except TooLargeError:
        return None
