"""Generations get better, and look at nothing twice."""

import numpy as np
import pytest

from grammarbt.bt import leaves
from grammarbt.search import BatchSearcher, Evaluation, Evolution, EvolutionParameters, Moves, Scorer


class Lists:
    """Derivations that change by one move."""

    def __init__(self, moves, rng):
        self.moves, self.rng = moves, rng

    def first(self, n):
        return [self.stranger() for _ in range(n)]

    def stranger(self):
        return self.moves.grammar.sample(self.rng)

    def child(self, one, other):
        return self.moves.regenerate(self.moves.tree(one), self.rng) or other

    def derivation(self, genome):
        return genome


@pytest.fixture
def evolve(grammars):
    def run(name, episodes, **parameters):
        rng = np.random.default_rng(0)
        moves = Moves(grammars[name])
        evolution = Evolution(Lists(moves, rng), Scorer(moves.states), EvolutionParameters(**parameters), 1_000, rng)
        searcher, trees = BatchSearcher("lists", evolution), []
        while len(trees) < episodes and (asked := searcher.ask(16)):
            trees += [proposal.tree for proposal in asked]
            searcher.tell([answer(proposal) for proposal in asked])
        return searcher, trees

    return run


def answer(proposal):
    value = sum(leaf.name == "a" for leaf in leaves(proposal.tree)) - 0.01 * len(str(proposal.tree))
    return Evaluation(proposal, (value,) * (proposal.stop - proposal.start))


def test_the_best_list_is_found(evolve):
    searcher, _ = evolve("lists", 1_500)
    assert {leaf.name for leaf in leaves(searcher.candidates(1)[0])} == {"a"}


def test_no_derivation_is_simulated_twice_where_that_shows_nothing_new(evolve):
    searcher, trees = evolve("lists", 1_500)
    assert len(set(trees)) > 0.95 * len(trees)
    assert searcher.metrics()["generations"] > 10


def test_it_ends_when_nothing_new_is_found(evolve):
    _, trees = evolve("unique", 5_000, population=20)
    assert 200 < len(set(trees)) <= 325
    assert len(trees) < 5_000


def test_the_population_grows_with_the_budget_unless_it_is_given():
    sizes = [EvolutionParameters().size(budget) for budget in (100, 4_000, 10**6)]
    assert sizes == [50, 100, 500]
    assert EvolutionParameters(population=7).size(10**6) == 7


@pytest.mark.parametrize(("distinct", "fewest", "most"), [(False, 30, 40), (True, 1, 15)])
def test_of_equal_means_one_lives_on_where_individuals_are_to_be_distinct(grammars, distinct, fewest, most):
    rng = np.random.default_rng(0)
    moves = Moves(grammars["lists"])
    parameters = EvolutionParameters(population=40, elites=0.9, distinct=distinct)
    searcher = BatchSearcher("lists", Evolution(Lists(moves, rng), Scorer(moves.states), parameters, 1_000, rng))
    asked = searcher.ask(100)
    searcher.tell([Evaluation(proposal, (float(at % 3),) * width(proposal)) for at, proposal in enumerate(asked)])
    known = {proposal.tree for proposal in asked}
    assert fewest <= sum(proposal.tree in known for proposal in searcher.ask(100)) <= most


def width(proposal):
    return proposal.stop - proposal.start


def test_a_new_population_begins_when_the_best_stays_as_it_is(evolve):
    restarts = [evolve("lists", 1_500, patience=patience)[0].metrics()["restarts"] for patience in (0, 3)]
    assert restarts[0] == 0 < restarts[1]
