"""Generations of genomes: tournaments, elitism, and nothing simulated that is known already."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Generic, Protocol, TypeVar

import numpy as np
from attrs import field, frozen, validators

from grammarbt.bt import BehaviorTree
from grammarbt.grammar import Derivation
from grammarbt.search.batches import Batches, Width
from grammarbt.search.moves import pick
from grammarbt.search.scoring import Score, Scorer

Genome = TypeVar("Genome")

CHILDREN = 20
"""Children bred in search of one that was not simulated yet, before a stranger takes its place."""

STRANGERS = 1_000
"""Strangers looked at, at most, for the same."""


@frozen(kw_only=True)
class EvolutionParameters:
    """Of how generations follow each other."""

    population: int | None = field(
        default=None,
        validator=validators.optional(validators.ge(2)),
        metadata={"help": "individuals in a generation; unset: a fortieth of the budget, from 50 to 500"},
    )
    tournament: int = field(
        default=5,
        validator=validators.ge(1),
        metadata={"help": "individuals of which the best becomes a parent"},
    )
    elites: float = field(
        default=0.1,
        validator=[validators.ge(0.0), validators.lt(1.0)],
        metadata={"help": "share of a generation, the best for sure, that lives on"},
    )
    distinct: bool = field(
        default=False,
        metadata={"help": "of individuals with equal means only one lives on or breeds, so that no plateau takes over"},
    )
    patience: int = field(
        default=0,
        validator=validators.ge(0),
        metadata={"help": "generations without a better best after which a new population begins; 0: never"},
    )

    def size(self, budget: int) -> int:
        """Individuals in a generation."""
        return self.population or min(max(budget // 40, 50), 500)


class Species(Protocol[Genome]):
    """What evolves."""

    def first(self, n: int) -> list[Genome]:
        """The n genomes of the first generation."""
        ...

    def stranger(self) -> Genome:
        """A random genome."""
        ...

    def child(self, one: Genome, other: Genome) -> Genome:
        """A genome bred from two."""
        ...

    def derivation(self, genome: Genome) -> Derivation:
        """What the genome stands for; always the same."""
        ...


@frozen(eq=False)
class Individual(Generic[Genome]):
    """A genome, and what is known of its tree."""

    genome: Genome
    score: Score


class Evolution(Generic[Genome]):
    """Lets a species evolve.

    Args:
        species: what evolves.
        scorer: simulates.
        parameters: how.
        budget: episodes.
        rng: chance.
    """

    def __init__(
        self,
        species: Species[Genome],
        scorer: Scorer,
        parameters: EvolutionParameters,
        budget: int,
        rng: np.random.Generator,
    ) -> None:
        self.species = species
        self.scorer = scorer
        self.parameters = parameters
        self.size = parameters.size(budget)
        self.rng = rng
        self.generations = self.strangers = self.restarts = 0

    def batches(self, width: Width) -> Batches[None]:
        """Generation after generation; ends when no genome can be found that was not simulated yet."""
        del width  # a generation is wide enough
        genomes = self._first()
        while genomes:
            scores = yield from self.scorer.score([derivation for derivation, _ in genomes])
            self.generations += 1
            population = [Individual(genome, score) for (_, genome), score in zip(genomes, scores, strict=True)]
            genomes = self._first() if self._is_stuck(population) else self._next(population)

    def _first(self) -> list[tuple[Derivation, Genome]]:
        self._best, self._idle = float("-inf"), 0
        return [(self.species.derivation(genome), genome) for genome in self.species.first(self.size)]

    def _is_stuck(self, population: Sequence[Individual[Genome]]) -> bool:
        """Whether too many generations passed without a better best."""
        best = max(map(self._sure, population))
        self._idle = 0 if best > self._best else self._idle + 1
        self._best = max(best, self._best)
        stuck = 0 < self.parameters.patience <= self._idle
        self.restarts += stuck
        return stuck

    def _next(self, population: Sequence[Individual[Genome]]) -> list[tuple[Derivation, Genome]]:
        """The elites and their children; nobody if there is nothing new to be found."""
        ranked = sorted(population, key=self._sure)
        if self.parameters.distinct:
            population = ranked = list({one.score.mean: one for one in ranked}.values())
        best = {one.score.derivation: one.genome for one in ranked}
        elites = list(best.items())[::-1][: int(self.parameters.elites * self.size)]
        children: dict[Derivation, Genome] = {}
        while len(children) < self.size - len(elites) and (child := self._new_child(population, children)):
            children[child[0]] = child[1]
        return [*elites, *children.items()] if children else []

    def _sure(self, one: Individual[Genome]) -> float:
        return self.scorer.sure(one.score)

    def _new_child(
        self, population: Sequence[Individual[Genome]], siblings: dict[Derivation, Genome]
    ) -> tuple[Derivation, Genome] | None:
        """A child that no sibling resembles, and that was not simulated yet if that would show nothing new."""
        for attempt in range(CHILDREN + STRANGERS):
            if attempt < CHILDREN:
                genome = self.species.child(self._winner(population), self._winner(population))
            else:
                genome = self.species.stranger()
            derivation = self.species.derivation(genome)
            if derivation not in siblings and not self.scorer.is_settled(derivation):
                self.strangers += attempt >= CHILDREN
                return derivation, genome
        return None

    def _winner(self, population: Sequence[Individual[Genome]]) -> Genome:
        entrants = [pick(population, self.rng) for _ in range(self.parameters.tournament)]
        return max(entrants, key=lambda one: one.score.mean).genome

    def candidates(self, n: int) -> Sequence[BehaviorTree]:
        """The trees that are best for sure."""
        return self.scorer.best(n)

    def metrics(self) -> dict[str, float]:
        """How far it got."""
        return {
            "generations": self.generations,
            "derivations": len(self.scorer.scores),
            "strangers": self.strangers,
            "restarts": self.restarts,
        }
