"""From genomes to derivations, by tables: what may be done where is worked out once, and what is forced is skipped."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, partial
from typing import Literal, TypeAlias

import numpy as np
from attrs import define, field, frozen

from grammarbt.grammar import Derivation
from grammarbt.search import State, States, Transition

MappingName: TypeAlias = Literal["linear", "structured"]

Genome: TypeAlias = tuple[tuple[int, ...], ...]
"""Lists of codons: a single one in linear mapping, one per nonterminal in structured mapping."""

ReadCodon: TypeAlias = tuple[int, int, int]
"""A step of the derivation, a list of the genome, and the codon of that list that chose the step."""

CODONS = 2**16
"""Codons are the numbers below."""


@define(eq=False)
class Leg:
    """Steps up to the next choice, or until the next nonterminal comes from the stack.

    Attributes:
        steps: productions.
        waiting: nonterminals for the stack.
        make: works out what follows a choice, or a nonterminal from the stack, and enters it into the tables below.
        choices: what follows each choice, once it was made; empty where there is none.
        gene: which of the genome's lists the choice's codon comes from.
        shortest: the choice that leads to the lowest sub-tree.
        above: what follows each nonterminal from the stack, once it came.
    """

    steps: Derivation
    waiting: tuple[int, ...]
    make: Callable[[int], Leg] = field(repr=False)
    choices: list[Leg | None] = field(factory=list, repr=False)
    gene: int = 0
    shortest: int = 0
    above: dict[int, Leg] = field(factory=dict, repr=False)


@frozen(slots=False, eq=False)  # slots=False: cached_property keeps its value in the instance's dict
class Reading:
    """A genome as a mapper reads it.

    Attributes:
        mapper: reads it.
        genome: what is read.
        derivation: what the genome stands for.
    """

    mapper: Mapper
    genome: Genome
    derivation: Derivation

    @cached_property
    def codons(self) -> tuple[ReadCodon, ...]:
        """In the order read, each with the step of the derivation that it chose, and the list that it is from."""
        codons: list[ReadCodon] = []
        self.mapper.derivation(self.genome, codons)
        return tuple(codons)


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
        self._choices: dict[State, list[Leg | None]] = {}
        self._shared: dict[tuple[int, ...], tuple[int, ...]] = {}
        self._first = self._leg(_into(states.start), [])

    def read(self, genome: Genome) -> Reading:
        """The genome, and what it stands for."""
        return Reading(self, genome, self.derivation(genome))

    def derivation(self, genome: Genome, noted: list[ReadCodon] | None = None) -> Derivation:
        """What the genome stands for; notes what is read, if asked to."""
        read = [0] * self.lists
        derivation: list[int] = []
        stack: list[int] = []
        leg = self._first
        while True:
            derivation += leg.steps
            if leg.waiting:
                stack += leg.waiting
            choices = leg.choices
            if choices:
                gene = leg.gene
                at, codons = read[gene], genome[gene]
                read[gene] = at + 1
                codon = codons[at] if at < len(codons) else self._again(codons, at, leg)
                if noted is not None:
                    noted.append((len(derivation), gene, codon))
                choice = codon % len(choices)
                leg = choices[choice] or leg.make(choice)
            elif stack:
                symbol = stack.pop()
                leg = leg.above.get(symbol) or leg.make(symbol)
            else:
                return tuple(derivation)

    def _again(self, codons: tuple[int, ...], at: int, leg: Leg) -> int:
        """The codon where every one was read before."""
        return codons[at % len(codons)] if at < len(codons) * (1 + self.wraps) else leg.shortest

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

    def _leg(self, step: Transition, steps: list[int]) -> Leg:
        """After a step, on as long as there is no choice."""
        waiting = list(step.waiting)
        while step.down is not None or waiting:
            state = step.down or self.states.up(step, waiting.pop())
            if len(state.productions) > 1:
                return self._fork(state, steps, waiting)
            production = state.productions[0]
            step = self.states.step(state, production)
            steps.append(production)
            waiting += step.waiting
        above: dict[int, Leg] = {}
        return Leg(self._one(steps), (), partial(self._above, above, step), above=above)

    def _fork(self, state: State, steps: list[int], waiting: list[int]) -> Leg:
        """Steps to a state with a choice."""
        choices = self._choices.setdefault(state, [None] * len(state.productions))
        heights = [self.states.heights[production] for production in state.productions]
        make = partial(self._chosen, choices, state)
        shortest = heights.index(min(heights))
        return Leg(self._one(steps), self._one(waiting), make, choices, self._genes[state.symbol], shortest)

    def _chosen(self, choices: list[Leg | None], state: State, choice: int) -> Leg:
        production = state.productions[choice]
        found = choices[choice] = self._leg(self.states.step(state, production), [production])
        return found

    def _above(self, above: dict[int, Leg], step: Transition, symbol: int) -> Leg:
        found = above[symbol] = self._leg(_into(self.states.up(step, symbol)), [])
        return found

    def _one(self, numbers: list[int]) -> tuple[int, ...]:
        """One tuple for all that are equal: few differ, and the tables then fit into a processor's cache."""
        found = tuple(numbers)
        return self._shared.setdefault(found, found)


def _into(state: State) -> Transition:
    """A step that does nothing but lead to a state."""
    return Transition((), state, state.form)
