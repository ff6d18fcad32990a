"""Roll-outs: random words below the nodes of a DAG."""

from __future__ import annotations

from bisect import bisect_right
from itertools import accumulate
from typing import TypeAlias

from attrs import define, frozen

from grammarbt.grammar import BoundGrammar, Derivation, Pieces
from grammarbt.search import Proposal, States, complete, rearranged
from grammarbt_dagmcts.dag import ROOT, Dag
from grammarbt_dagmcts.draws import Draws

MAX_FORKS = 100_000
"""Pieces of forms for which it is kept what a roll-out may do next."""


@frozen(eq=False)
class RollOut:
    """The edges from the root to a node, and a random word below that node."""

    path: tuple[int, ...]
    proposal: Proposal


Way: TypeAlias = "tuple[int, str, Fork | None]"
"""A production, the nonterminals that it puts in, last one first, and what is left of the piece then, once it was taken."""


@define(eq=False)
class Fork:
    """What may be done at the first nonterminal of a piece.

    Attributes:
        text: the piece, spelled; none if nothing is left of it.
        ways: what is legal.
        bounds: running sums of the productions' weights.
        shortest: places of those ways after which the fewest productions are left to take.
    """

    text: str
    ways: list[Way]
    bounds: list[float]
    shortest: list[int]


class Forks:
    """The forks of a grammar, made as they are met."""

    def __init__(self, grammar: BoundGrammar, pieces: Pieces) -> None:
        self.grammar = grammar
        self.pieces = pieces
        names = {symbol: pieces.spelling.text(grammar.start(symbol)) for symbol in grammar.by_lhs}
        self._parts = tuple("".join(names[part] for part in parts[::-1]) for parts in grammar.parts)
        self._least = least_steps(grammar)
        self._known: dict[str, Fork] = {}

    def at(self, text: str) -> Fork:
        """The fork of a piece."""
        known = self._known.get(text)
        if known is None:
            if len(self._known) >= MAX_FORKS:
                self._known.clear()
            known = self._known[text] = self._made(text)
        return known

    def _made(self, text: str) -> Fork:
        legal = self.pieces.legal(text, self.pieces.spelling.positions(text)[0]) if text else ()
        weights = (self.grammar.productions[production].weight for production in legal)
        least = min((self._least[production] for production in legal), default=0.0)
        shortest = [place for place, production in enumerate(legal) if self._least[production] == least]
        ways: list[Way] = [(production, self._parts[production], None) for production in legal]
        return Fork(text, ways, list(accumulate(weights)), shortest)

    def step(self, fork: Fork, way: int) -> Fork:
        """What is left of a piece; independent nonterminals are pieces of their own."""
        spelling = self.pieces.spelling
        production, parts, _ = fork.ways[way]
        after = spelling.apply(fork.text, production, spelling.positions(fork.text)[0])
        own = (piece.text for piece in self.pieces.split(after) if piece.text not in self.pieces.independent)
        left = self.at(next(own, ""))
        fork.ways[way] = production, parts, left
        return left


class RollOuts:
    """Finishes trees by random productions, and the shortest way when they take too many.

    Args:
        dag: where roll-outs begin.
        draws: randomness.
        longest: random productions of a roll-out.
    """

    def __init__(self, dag: Dag, draws: Draws, longest: int) -> None:
        self.dag = dag
        self.draws = draws
        self.longest = longest
        self._states = States(dag.grammar)
        self._forks = Forks(dag.grammar, dag.pieces)

    def below(self, path: tuple[int, ...], scenario: int) -> RollOut:
        """A roll-out from the path's last node, to be simulated on one scenario."""
        edges = self.dag.edges
        template = rearranged(self.dag.grammar, ((edges.place[edge], edges.production[edge]) for edge in path))
        derivation = complete(template, self._finished(self.dag.texts[edges.child[path[-1]] if path else ROOT]))
        base = self.dag.grammar.base_derivation(derivation)
        return RollOut(path, Proposal(self._states.tree(derivation), base, scenario, scenario + 1))

    def _finished(self, text: str) -> list[Derivation]:
        """A random derivation from each of a form's nonterminals."""
        pieces = self.dag.pieces.split(text)
        forks = [self._forks.at(piece.text) for piece in pieces]
        owner = {place: number for number, piece in enumerate(pieces) for place in piece.places}
        found: list[Derivation] = []
        longest = self.longest
        for place, symbol in enumerate(self.dag.spelling.nonterminals(text)):
            number = owner[place]
            derivation, forks[number] = self._derived(symbol, forks[number], longest)
            found.append(derivation)
            longest -= len(derivation)
        return found

    def _derived(self, symbol: str, fork: Fork, longest: int) -> tuple[Derivation, Fork]:
        """A random derivation from the first nonterminal of what is left of a piece, and what is left then."""
        found: list[int] = []
        independent, drawn = self.dag.pieces.independent, self.draws.left
        stack: list[str] = [symbol]
        around: list[Fork] = []
        while stack:
            symbol = stack.pop()
            if not symbol:
                fork = around.pop()
                continue
            if symbol in independent:
                around.append(fork)
                stack.append("")
                fork = self._forks.at(symbol)
            if len(found) >= longest:
                way = fork.shortest[self.draws.below(len(fork.shortest))]
            elif len(fork.ways) == 1:
                way = 0
            else:
                draw = drawn.pop() if drawn else self.draws.ready(1).pop()
                way = bisect_right(fork.bounds, draw * fork.bounds[-1])
            production, parts, left = fork.ways[way]
            found.append(production)
            stack += parts
            fork = left or self._forks.step(fork, way)
        return tuple(found), fork


def least_steps(grammar: BoundGrammar) -> list[float]:
    """Per production, the productions of the shortest derivation that begins with it, constraints aside."""
    least: dict[int, float] = {}
    while True:
        steps = [
            1.0 + sum(least.get(symbol, float("inf")) for symbol in production.rhs if grammar.is_nonterminal(symbol))
            for production in grammar.productions
        ]
        shorter = {lhs: min(steps[production.number] for production in own) for lhs, own in grammar.by_lhs.items()}
        if shorter == least:
            return steps
        least = shorter
