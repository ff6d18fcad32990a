"""The smallest word of a language, and a shortest word that can be derived in two ways.

Both are best-first searches over the states of leftmost derivations; the number of tokens still to come is bounded
from below by what each nonterminal takes when no constraint is in the way.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Iterator
from itertools import count

from attrs import frozen

from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.leftmost import Move, Word
from grammarbt.grammar.table import Derivation

MAX_STATES = 10_000
"""How many states a search looks at before it gives up; a long one counts as several."""

MAX_LENGTH = 400
"""Words with more tokens are not looked for."""


@frozen
class Ambiguity:
    """A word with two of its derivations from a nonterminal."""

    symbol: int
    word: Word
    first: Derivation
    second: Derivation


@frozen
class Verdict:
    """What a search for an ambiguous word found; `complete` says whether it saw the whole language."""

    ambiguity: Ambiguity | None
    complete: bool


def find_ambiguity(grammar: BoundGrammar, most: int = MAX_STATES) -> Verdict:
    """Look for a shortest ambiguous word, in each block first, as these are small, then in whole trees."""
    least = least_lengths(grammar)
    complete = False
    for symbol in (*grammar.blocks, grammar.start_symbol):
        if least[symbol] > MAX_LENGTH:
            return Verdict(None, complete=False)
        found, looked_at, complete = _search(grammar, symbol, least, most)
        most -= looked_at
        if found or most <= 0:
            return Verdict(found, complete=False)
    return Verdict(None, complete)


def _search(grammar: BoundGrammar, symbol: int, least: dict[int, int], most: int) -> tuple[Ambiguity | None, int, bool]:
    """Shortest first; two ways to the same word and state stay together until the word is finished."""
    order, met = count(), _Met()
    heap: list[tuple[int, int, Word, SententialForm, Derivation, Derivation | None]]
    heap = [(0, next(order), (), grammar.start(symbol), (), None)]
    looked_at, complete = 0, True
    while heap and looked_at < most:
        _, _, word, state, one, another = heapq.heappop(heap)
        looked_at += _effort(state)
        pair = met.pair((word, state), one, another)
        if pair is None:
            continue
        first, second = pair
        if second is not None and not state.symbols:
            return Ambiguity(symbol, word, first, second), looked_at, False
        for length, longer, move in _longer(grammar, word, state, least):
            if length <= MAX_LENGTH:
                step = (move.production,)
                other = None if second is None else second + step
                heapq.heappush(heap, (length, next(order), longer, move.after, first + step, other))
            complete = complete and length <= MAX_LENGTH
    return None, looked_at, complete and not heap


class _Met:
    """Words with states that were met, and by which derivation first."""

    def __init__(self) -> None:
        self._first: dict[tuple[Word, SententialForm], Derivation] = {}
        self._twice: set[tuple[Word, SententialForm]] = set()

    def pair(
        self, place: tuple[Word, SententialForm], first: Derivation, second: Derivation | None
    ) -> tuple[Derivation, Derivation | None] | None:
        """The derivations that lead there, as far as they are known; None if two were known before."""
        if second is None and place not in self._first:
            self._first[place] = first
            return first, None
        if place in self._twice:
            return None
        self._twice.add(place)
        return (self._first[place], first) if second is None else (first, second)


def smallest_word(grammar: BoundGrammar, most: int = MAX_STATES) -> Word | None:
    """A word with the fewest tokens, or None if it takes too long to find."""
    least, order = least_lengths(grammar), count(0, -1)  # of equals, the youngest first: it is nearest to its end
    if least[grammar.start_symbol] > MAX_LENGTH:
        return None
    heap: list[tuple[int, int, Word, SententialForm]] = [(0, next(order), (), grammar.start())]
    seen: set[SententialForm] = set()
    while heap and most > 0:
        _, _, word, state = heapq.heappop(heap)
        most -= _effort(state)
        if not state.symbols:
            return word
        if state in seen:
            continue
        seen.add(state)
        for length, longer, move in _longer(grammar, word, state, least):
            if length <= MAX_LENGTH:
                heapq.heappush(heap, (length, next(order), longer, move.after))
    return None


def _longer(
    grammar: BoundGrammar, word: Word, state: SententialForm, least: dict[int, int]
) -> Iterator[tuple[int, Word, Move]]:
    """What each next production makes of the word, and how many tokens it then has in the end at least."""
    for move in grammar.leftmost.moves(state):
        longer = word + move.emits
        yield len(longer) + _least(grammar, move.after, least), longer, move


def _effort(state: SententialForm) -> int:
    return 1 + len(state.symbols) // 10


def _least(grammar: BoundGrammar, state: SententialForm, least: dict[int, int]) -> int:
    return sum(least[symbol] if symbol >= grammar.start_symbol else symbol >= 0 for symbol in state.symbols)


def least_lengths(grammar: BoundGrammar) -> dict[int, int]:
    """The fewest tokens each nonterminal can become, constraints aside."""
    found: dict[int, int] = {}
    changed = True
    while changed:
        changed = False
        for production in reversed(grammar.productions):  # those met last use the fewest others
            length = _length(grammar, production.rhs, found)
            if length is not None and length < found.get(production.lhs, length + 1):
                found[production.lhs] = length
                changed = True
    return found


def _length(grammar: BoundGrammar, symbols: Iterable[int], least: dict[int, int]) -> int | None:
    total = 0
    for symbol in symbols:
        if symbol < grammar.start_symbol:
            total += 1
        elif symbol in least:
            total += least[symbol]
        else:
            return None
    return total
