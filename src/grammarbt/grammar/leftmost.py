"""Leftmost derivations as a walk over states, each computed once.

A state is a sentential form without the finished part to its left; a move is a production of its first nonterminal,
and says which terminals become final by it. Everything that counts, samples or lists a language walks these states.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from itertools import accumulate
from typing import TypeAlias

import numpy as np
from attrs import frozen

from grammarbt.errors import GrammarError
from grammarbt.grammar.form import SententialForm
from grammarbt.grammar.rewriting import Forms
from grammarbt.grammar.table import CLOSE, Derivation, ProductionTable

Word: TypeAlias = tuple[int, ...]
"""Numbers of terminals."""

MAX_KEPT = 4_000_000
"""Symbols of states, all together, that are kept."""

MAX_UNFINISHED = 2_000
"""Symbols that a state of a random walk may have, apart from those of one production; trees seldom need a tenth."""

MAX_STEPS = 3_500
"""Steps of a random walk; a tree of a thousand nodes takes two or three thousand."""

DRAWS = 32
"""Random numbers drawn at a time; about what a tree takes."""


@frozen(eq=False)
class Move:
    """One production at a state's first nonterminal: the terminals it finishes and the state after it."""

    production: int
    emits: Word
    after: SententialForm


_Leg: TypeAlias = "tuple[Derivation, Word, _Fork | None]"
"""Moves made one after the other, what they spell, and where the next choice is; None at the end of the word."""


@frozen(eq=False)
class _Fork:
    """A state with several moves; random walks go from fork to fork and look no state up on the way.

    Attributes:
        moves: what may be done.
        total: the sum of the moves' weights.
        bounds: the sums of the first one, two, … of them.
        legs: what each move leads to, once it has been taken.
    """

    moves: tuple[Move, ...]
    total: float
    bounds: list[float]
    legs: list[_Leg | None]


class Leftmost:
    """The states of a grammar's leftmost derivations, kept as they are met."""

    def __init__(self, grammar: ProductionTable, forms: Forms) -> None:
        self.grammar = grammar
        self.forms = forms
        self._moves: dict[SententialForm, tuple[Move, ...]] = {}
        self._forks: dict[SententialForm, _Fork] = {}
        self._kept = 0
        self._most = MAX_UNFINISHED + max(len(production.rhs) for production in grammar.productions)

    def moves(self, state: SententialForm) -> tuple[Move, ...]:
        """What may be done at the state's first nonterminal; empty only when nothing is left to derive."""
        known = self._moves.get(state)
        if known is None:
            self._kept += len(state.symbols)
            if self._kept > MAX_KEPT:
                self._kept = 0
                self._moves.clear()
                self._forks.clear()
            known = self._moves[state] = tuple(self._computed(state))
        return known

    def _computed(self, state: SententialForm) -> Iterator[Move]:
        at = next((at for at, symbol in enumerate(state.symbols) if symbol >= self.grammar.start_symbol), None)
        if at is None:
            return
        for production in self.grammar.by_lhs.get(state.symbols[at], ()):
            form = self.forms.applied(state, production, at)
            if form is not None and self.forms.can_finish(form):
                emits, after = self.split(form)
                yield Move(production.number, emits, after)

    def split(self, form: SententialForm) -> tuple[Word, SententialForm]:
        """The terminals before the first nonterminal, and the rest; scopes that are still open stay open."""
        kept: list[int] = []
        used: list[tuple[int, ...]] = []
        emits: list[int] = []
        opened = 0
        for at, symbol in enumerate(form.symbols):
            if symbol >= self.grammar.start_symbol:
                rest = SententialForm((*kept, *form.symbols[at:]), (*used, *form.used[opened:]))
                return tuple(emits), rest
            if symbol == CLOSE:
                kept.pop()
                used.pop()
            elif symbol < 0:
                kept.append(symbol)
                used.append(form.used[opened])
                opened += 1
            else:
                emits.append(symbol)
        return tuple(emits), SententialForm(())

    def random_walk(self, state: SententialForm, rng: np.random.Generator) -> tuple[Derivation, Word]:
        """Derive a word from a state, choosing among legal moves by weight.

        Raises:
            GrammarError: the tree grows and grows.
        """
        steps, emits, fork = self._leg((), (), state)
        derivation, word = [*steps], [*emits]
        draws: list[float] = []
        while fork is not None:
            if len(derivation) > MAX_STEPS:
                raise self._growth()
            if not draws:
                draws = rng.random(DRAWS).tolist()
            at = bisect_right(fork.bounds, draws.pop() * fork.total)
            steps, emits, fork = fork.legs[at] or self._first_time(fork, at)
            derivation += steps
            word += emits
        return tuple(derivation), tuple(word)

    def _first_time(self, fork: _Fork, at: int) -> _Leg:
        move = fork.moves[at]
        leg = fork.legs[at] = self._leg((move.production,), move.emits, move.after)
        return leg

    def _leg(self, derivation: Derivation, word: Word, state: SententialForm) -> _Leg:
        while len(moves := self.moves(state)) == 1:
            derivation += (moves[0].production,)
            word += moves[0].emits
            state = moves[0].after
        if len(state.symbols) > self._most:
            raise self._growth()
        return derivation, word, self._fork(state, moves) if moves else None

    def _growth(self) -> GrammarError:
        message = f"{self.grammar.grammar.source.name}: a random tree passes {MAX_STEPS:,} steps or {MAX_UNFINISHED:,} open ends"
        return GrammarError(
            message, "limit it, for example with `%limit nodes 40`, or give alternatives that end more weight"
        )

    def _fork(self, state: SententialForm, moves: tuple[Move, ...]) -> _Fork:
        known = self._forks.get(state)
        if known is None:
            shares = list(accumulate(self.grammar.productions[move.production].weight for move in moves))
            known = self._forks[state] = _Fork(moves, shares.pop(), shares, [None] * len(moves))
        return known

    def follow(self, state: SententialForm, derivation: Derivation) -> tuple[Word, SententialForm]:
        """What a derivation, or the first part of one, makes of a state.

        Raises:
            KeyError: it takes a move that is not there; the argument is the place in the derivation.
        """
        word: list[int] = []
        for at, number in enumerate(derivation):
            move = next((move for move in self.moves(state) if move.production == number), None)
            if move is None:
                raise KeyError(at)
            word.extend(move.emits)
            state = move.after
        return tuple(word), state

    def words(self, state: SententialForm, most: int) -> Iterator[tuple[Derivation, Word]]:
        """Every derivation with its word, depth-first, stopping after `most`."""
        stack: list[tuple[SententialForm, Derivation, Word]] = [(state, (), ())]
        while stack and most > 0:
            state, derivation, word = stack.pop()
            moves = self.moves(state)
            if not moves:
                most -= 1
                yield derivation, word
            stack.extend((move.after, (*derivation, move.production), (*word, *move.emits)) for move in reversed(moves))
