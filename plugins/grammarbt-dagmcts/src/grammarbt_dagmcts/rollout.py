"""Roll-outs: random words below the nodes of a DAG."""

from __future__ import annotations

from bisect import bisect_right
from itertools import accumulate

import numpy as np
from attrs import define, field, frozen

from grammarbt.grammar import BoundGrammar, Derivation, Pieces
from grammarbt.search import Proposal, States, complete, pick, rearranged
from grammarbt_dagmcts.dag import ROOT, Dag

MAX_FORKS = 100_000
"""Pieces of forms for which it is kept what a roll-out may do next."""


@frozen(eq=False)
class RollOut:
    """The edges from the root to a node, and a random word below that node."""

    path: tuple[int, ...]
    proposal: Proposal


@define(eq=False)
class Fork:
    """What may be done at the first nonterminal of a piece.

    Attributes:
        text: the piece, spelled.
        productions: the legal ones.
        bounds: running sums of their weights.
        shortest: those of them after which the fewest are left to do.
        after: what is left of the piece after each production, once taken; no text if nothing is.
    """

    text: str
    productions: tuple[int, ...]
    bounds: list[float]
    shortest: list[int]
    after: dict[int, Fork] = field(factory=dict)

    def draw(self, rng: np.random.Generator) -> int:
        """A production by weight."""
        if len(self.productions) == 1:
            return self.productions[0]
        return self.productions[bisect_right(self.bounds, rng.random() * self.bounds[-1])]


@define(eq=False)
class Walk:
    """A piece that is being derived, from left to right."""

    fork: Fork


class Forks:
    """The forks of a grammar, made as they are met."""

    def __init__(self, grammar: BoundGrammar, pieces: Pieces) -> None:
        self.grammar = grammar
        self.pieces = pieces
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
        shortest = [production for production in legal if self._least[production] == least]
        return Fork(text, legal, list(accumulate(weights)), shortest)

    def step(self, fork: Fork, production: int) -> Fork:
        """What is left of a piece; independent nonterminals are pieces of their own."""
        spelling = self.pieces.spelling
        after = spelling.apply(fork.text, production, spelling.positions(fork.text)[0])
        own = (piece.text for piece in self.pieces.split(after) if piece.text not in self.pieces.independent)
        left = fork.after[production] = self.at(next(own, ""))
        return left


class RollOuts:
    """Finishes trees by random productions, and the shortest way when they take too many.

    Args:
        dag: where roll-outs begin.
        rng: randomness.
        longest: random productions of a roll-out.
    """

    def __init__(self, dag: Dag, rng: np.random.Generator, longest: int) -> None:
        self.dag = dag
        self.rng = rng
        self.longest = longest
        self._states = States(dag.grammar)
        self._forks = Forks(dag.grammar, dag.pieces)
        spelled = dag.spelling.text
        names = {symbol: spelled(dag.grammar.start(symbol)) for symbol in dag.grammar.by_lhs}
        self._parts = tuple("".join(names[part] for part in parts[::-1]) for parts in dag.grammar.parts)

    def below(self, path: tuple[int, ...], scenario: int) -> RollOut:
        """A roll-out from the path's last node, to be simulated on one scenario."""
        edges = self.dag.edges
        template = rearranged(self.dag.grammar, ((edges.place[edge], edges.production[edge]) for edge in path))
        derivation = complete(template, self._finished(self.dag.texts[edges.child[path[-1]] if path else ROOT]))
        base = self.dag.grammar.base_derivation(derivation)
        return RollOut(path, Proposal(self._states.tree(derivation), base, scenario, scenario + 1))

    def _finished(self, text: str) -> list[Derivation]:
        """A random derivation from each of a form's nonterminals."""
        walks: dict[int, Walk] = {}
        for piece in self.dag.pieces.split(text):
            walks.update(dict.fromkeys(piece.places, Walk(self._forks.at(piece.text))))
        found: list[Derivation] = []
        left = self.longest
        for place, symbol in enumerate(self.dag.spelling.nonterminals(text)):
            found.append(self._derived(symbol, walks[place], left))
            left -= len(found[-1])
        return found

    def _derived(self, symbol: str, walk: Walk, longest: int) -> Derivation:
        """A random derivation from the first nonterminal of what is left of a piece."""
        found: list[int] = []
        independent, rng = self.dag.pieces.independent, self.rng
        stack = [(symbol, walk)]
        while stack:
            symbol, walk = stack.pop()
            if symbol in independent and walk.fork.text != symbol:
                walk = Walk(self._forks.at(symbol))
            fork = walk.fork
            production = fork.draw(rng) if len(found) < longest else pick(fork.shortest, rng)
            found.append(production)
            walk.fork = fork.after.get(production) or self._forks.step(fork, production)
            stack += [(part, walk) for part in self._parts[production]]
        return tuple(found)


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
