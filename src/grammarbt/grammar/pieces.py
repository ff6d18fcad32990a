"""The pieces of a form: parts that are derived each by itself, as nothing in one has a say in what is legal in another.

A nonterminal is *independent* if nothing below it counts for a scope around it. What is legal in the scope that it opens
then follows from that scope alone. Forms differ in many ways, their pieces in few: what is legal is worked out once.
"""

from __future__ import annotations

from attrs import define, field

from grammarbt.grammar.bound import BoundGrammar
from grammarbt.grammar.reach import reachable
from grammarbt.grammar.spelling import CLOSED, Spelling

MAX_KEPT = 200_000
"""Nonterminals of pieces for which it is kept what is legal."""


@define
class Piece:
    """A form, spelled without what does not matter, and the places of its nonterminals among those of the whole form."""

    text: str = ""
    places: list[int] = field(factory=list)


class Pieces:
    """Takes forms apart, and knows what is legal in their pieces.

    Attributes:
        spelling: how forms are spelled.
        independent: the characters of independent nonterminals.
    """

    def __init__(self, spelling: Spelling) -> None:
        grammar = spelling.grammar
        self.spelling = spelling
        self.independent = frozenset(
            spelling.text(grammar.start(symbol)) for symbol in grammar.by_lhs if is_independent(grammar, symbol)
        )
        # Where depth is limited, it is counted by the parentheses that are still to be closed.
        kept = [symbol for symbol in grammar.brackets if grammar.depth_constraints and symbol >= 0]
        self._bare = {symbol + 1: None for symbol in range(len(grammar.terminals)) if symbol not in kept}
        self._parentheses = "".join(chr(symbol + 1) for symbol in kept)
        self._legal: dict[tuple[str, int], tuple[int, ...]] = {}

    def split(self, text: str) -> list[Piece]:
        """The pieces that have something left to derive."""
        found: list[Piece] = []
        around: list[Piece] = []
        piece, place = Piece(), 0
        for character in text.translate(self._bare):
            if character >= self.spelling.first_scope:
                around.append(piece)
                piece = Piece(character)
            elif character == CLOSED:
                piece = self._closed(piece, around.pop(), found)
            elif ord(character) <= self.spelling.grammar.start_symbol:
                piece.text += character
            else:
                self._place(character, place, piece, found)
                place += 1
        if piece.places:
            found.append(piece)
        for piece in found:
            while self._parentheses and self._parentheses in piece.text:
                piece.text = piece.text.replace(self._parentheses, "")
        return found

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
        found = [
            (place, production)
            for piece in self.split(text)
            for place, at in zip(piece.places, self.spelling.positions(piece.text), strict=True)
            for production in self.legal(piece.text, at)
        ]
        return sorted(found)


def is_independent(grammar: BoundGrammar, nonterminal: int) -> bool:
    """Whether what the nonterminal derives has no say in what may stand around it."""
    around = grammar.encloses_of(nonterminal)

    def parts(symbol: int) -> list[int]:
        return [part for production in grammar.by_lhs.get(symbol, ()) for part in grammar.parts[production.number]]

    below = (production for symbol in reachable(nonterminal, parts) for production in grammar.by_lhs.get(symbol, ()))
    if any(production.use[constraint] for production in below for constraint in around):
        return False
    return not around & grammar.depth_constraints
