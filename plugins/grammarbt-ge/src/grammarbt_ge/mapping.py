"""From genomes to derivations, by tables: what may be done where is worked out once, and what is forced is skipped."""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np
from attrs import define, field

from grammarbt.grammar import Derivation
from grammarbt.search import State, States, Transition

MappingName: TypeAlias = Literal["linear", "structured"]

Genome: TypeAlias = tuple[tuple[int, ...], ...]
"""Lists of codons: a single one in linear mapping, one per nonterminal in structured mapping."""

CODONS = 2**16
"""Codons are the numbers below."""


@define(eq=False)
class Fork:
    """A state with a choice.

    Attributes:
        state: the state.
        gene: which of the genome's lists its codons come from.
        choices: how many there are.
        shortest: the choice that leads to the lowest sub-tree.
        legs: what each choice leads to, once it has been made.
    """

    state: State = field(repr=False)
    gene: int
    choices: int
    shortest: int
    legs: list[Leg | None] = field(repr=False)


@define(eq=False)
class Leg:
    """Steps up to the next choice.

    Attributes:
        steps: productions.
        waiting: nonterminals for the stack.
        fork: the next choice; None where the next nonterminal comes from the stack.
        last: the last step.
        up: the leg that follows, for each nonterminal that came from there.
    """

    steps: Derivation
    waiting: tuple[int, ...]
    fork: Fork | None
    last: Transition = field(repr=False)
    up: dict[int, Leg] = field(factory=dict, init=False, repr=False)


class Mapper:
    """Maps genomes: a codon, modulo the number of legal productions, chooses among them.

    A list of codons is read again from its beginning when it is at its end. After `wraps` times that, the choice falls
    on the production that leads to the lowest sub-tree, so that every genome has a tree.

    Args:
        states: of the grammar.
        mapping: linear after O'Neill & Ryan (2001), structured after Lourenço, Pereira & Costa (2016).
        wraps: how often a list is read again.
    """

    def __init__(self, states: States, mapping: MappingName, wraps: int) -> None:
        self.states = states
        self.wraps = wraps
        symbols = list(states.grammar.by_lhs)
        self._genes = {symbol: at if mapping == "structured" else 0 for at, symbol in enumerate(symbols)}
        self.lists = len(symbols) if mapping == "structured" else 1
        self._forks: dict[State, Fork] = {}
        self._first = self._leg(_into(states.start), [])

    def derivation(self, genome: Genome) -> Derivation:
        """What the genome stands for."""
        codons = list(map(iter, genome))
        again = [self.wraps] * self.lists
        derivation: list[int] = []
        stack: list[int] = []
        leg = self._first
        while True:
            derivation += leg.steps
            stack += leg.waiting
            fork = leg.fork
            if fork is not None:
                codon = next(codons[fork.gene], -1)
                if codon < 0 < again[fork.gene]:
                    again[fork.gene] -= 1
                    codons[fork.gene] = iter(genome[fork.gene])
                    codon = next(codons[fork.gene], -1)
                at = codon % fork.choices if codon >= 0 else fork.shortest
                leg = fork.legs[at] or self._chosen(fork, at)
            elif stack:
                symbol = stack.pop()
                leg = leg.up.get(symbol) or self._above(leg, symbol)
            else:
                return tuple(derivation)

    def genome(self, derivation: Derivation, rng: np.random.Generator) -> Genome:
        """A genome that maps to the derivation; of all codons that make a choice, any is as likely."""
        lists: list[list[int]] = [[] for _ in range(self.lists)]
        walk = self.states.walk()
        for production in derivation:
            state = walk.state
            if state is not None and len(state.productions) > 1:
                choices = len(state.productions)
                at = state.productions.index(production)
                most = (CODONS - at + choices - 1) // choices
                lists[self._genes[state.symbol]].append(at + choices * int(rng.random() * most))
            walk.take(production)
        return tuple(map(tuple, lists))

    def _chosen(self, fork: Fork, at: int) -> Leg:
        production = fork.state.productions[at]
        leg = fork.legs[at] = self._leg(self.states.step(fork.state, production), [production])
        return leg

    def _above(self, leg: Leg, symbol: int) -> Leg:
        above = leg.up[symbol] = self._leg(_into(self.states.up(leg.last, symbol)), [])
        return above

    def _leg(self, step: Transition, steps: list[int]) -> Leg:
        """After a step, on as long as there is no choice."""
        waiting = list(step.waiting)
        while step.down is not None or waiting:
            state = step.down or self.states.up(step, waiting.pop())
            if len(state.productions) > 1:
                return Leg(tuple(steps), tuple(waiting), self._fork(state), step)
            production = state.productions[0]
            step = self.states.step(state, production)
            steps.append(production)
            waiting += step.waiting
        return Leg(tuple(steps), (), None, step)

    def _fork(self, state: State) -> Fork:
        fork = self._forks.get(state)
        if fork is None:
            heights = [self.states.heights[production] for production in state.productions]
            shortest = heights.index(min(heights))
            fork = Fork(state, self._genes[state.symbol], len(heights), shortest, [None] * len(heights))
            self._forks[state] = fork
        return fork


def _into(state: State) -> Transition:
    """A step that does nothing but lead to a state."""
    return Transition((), state, state.form)
