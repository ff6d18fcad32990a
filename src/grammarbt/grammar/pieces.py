"""The pieces of a form: parts that are derived each by itself, as nothing in one has a say in what is legal in another.

A nonterminal is *independent* if nothing below it counts for a scope around it. What is legal in the scope that it opens
then follows from that scope alone. Forms differ in many ways, their pieces in few: what is legal is worked out once.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from attrs import define, field

from grammarbt.grammar.spelling import CLOSED, Spelling

MAX_KEPT = 200_000
"""Nonterminals of pieces for which it is kept what is legal."""


@define
class Piece:
    """A form, spelled without what does not matter, and the places of its nonterminals among those of the whole form."""

    text: str = ""
    places: list[int] = field(factory=list)


_Apart: TypeAlias = tuple[list[Piece], str, int]
"""Pieces, what is left around them, and how many nonterminals there are in all."""


class Pieces:
    """Takes forms apart, and knows what is legal in their pieces.

    Attributes:
        spelling: how forms are spelled.
        independent: the characters of independent nonterminals.
    """

    def __init__(self, spelling: Spelling) -> None:
        grammar = spelling.grammar
        self.spelling = spelling
        self.independent = spelling.independent
        # Where depth is limited, it is counted by the parentheses that are still to be closed.
        kept = [symbol for symbol in grammar.brackets if grammar.depth_constraints and symbol >= 0]
        self._first_nonterminal = chr(grammar.start_symbol + 1)
        self._parentheses = "".join(chr(symbol + 1) for symbol in kept)
        self._legal: dict[tuple[str, int], tuple[int, ...]] = {}
        self._options: dict[str, list[tuple[int, int]]] = {}
        self._scopes: dict[str, _Apart] = {}

    def split(self, text: str) -> list[Piece]:
        """The pieces that have something left to derive."""
        found, _, _ = self._apart(self.spelling.tokens(text))
        for piece in found:
            while self._parentheses and self._parentheses in piece.text:
                piece.text = piece.text.replace(self._parentheses, "")
        return found

    def _apart(self, tokens: Iterable[str]) -> _Apart:
        found: list[Piece] = []
        around: list[Piece] = []
        piece, place = Piece(), 0
        for token in tokens:
            if len(token) > 1:
                inside, rest, nonterminals = self._scope_apart(token)
                found += [Piece(own.text, [place + inner for inner in own.places]) for own in inside]
                piece.text += rest
                place += nonterminals
            elif CLOSED < token < self._first_nonterminal:
                if token in self._parentheses:
                    piece.text += token
            elif token >= self.spelling.first_scope:
                around.append(piece)
                piece = Piece(token)
            elif token == CLOSED:
                piece = self._closed(piece, around.pop(), found)
            else:
                self._place(token, place, piece, found)
                place += 1
        if piece.places:
            found.append(piece)
        return found, piece.text, place

    def _scope_apart(self, scope: str) -> _Apart:
        known = self._scopes.get(scope)
        if known is None:
            if len(self._scopes) >= MAX_KEPT:
                self._scopes.clear()
            known = self._scopes[scope] = self._apart([*scope])
        return known

    def _closed(self, piece: Piece, around: Piece, found: list[Piece]) -> Piece:
        """What is around a scope that closes: the scope is a piece, or part of the piece around it, or done with."""
        if not piece.places:
            around.text += piece.text[1:]
        elif self._opener(piece.text[0]) in self.independent:
            found.append(Piece(piece.text + CLOSED, piece.places))
        else:
            around.text += piece.text + CLOSED
            around.places += piece.places
        return around

    def _place(self, character: str, place: int, piece: Piece, found: list[Piece]) -> None:
        if character in self.independent:
            found.append(Piece(character, [place]))
        else:
            piece.text += character
            piece.places.append(place)

    def _opener(self, scope: str) -> str:
        return chr(self.spelling.grammar.opened_by(self.spelling.symbol(scope)) + 1)

    def legal(self, text: str, at: int) -> tuple[int, ...]:
        """The productions of the nonterminal at a position of a piece after which the piece can still be finished."""
        known = self._legal.get((text, at))
        if known is None:
            if len(self._legal) >= MAX_KEPT:
                self._legal.clear()
            own = self.spelling.grammar.by_lhs.get(self.spelling.symbol(text[at]), ())
            known = tuple(production.number for production in own if self._is_legal(text, production.number, at))
            self._legal[text, at] = known
        return known

    def _is_legal(self, text: str, production: int, at: int) -> bool:
        after = self.spelling.applied(text, production, at)
        return after is not None and self.spelling.grammar.forms.can_finish(self.spelling.form(after))

    def options(self, text: str) -> list[tuple[int, int]]:
        """What may be done to a form: the place of a nonterminal among them, and a production; by place."""
        return sorted(
            (piece.places[at], production)
            for piece in self.split(text)
            for at, production in self._options_of(piece.text)
        )

    def _options_of(self, text: str) -> list[tuple[int, int]]:
        """The same of a piece, by the place in it."""
        known = self._options.get(text)
        if known is None:
            if len(self._options) >= MAX_KEPT:
                self._options.clear()
            known = self._options[text] = [
                (place, production)
                for place, at in enumerate(self.spelling.positions(text))
                for production in self.legal(text, at)
            ]
        return known
