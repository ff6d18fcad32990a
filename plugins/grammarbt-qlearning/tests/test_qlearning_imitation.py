"""The best tree is repeated but for one decision, once it has proved its worth."""

import numpy as np
import pytest
from attrs import evolve

from grammarbt.bt import leaves, parse
from grammarbt.grammar import parse_tree
from grammarbt.search import States
from grammarbt.testing import errands, letters
from grammarbt_qlearning.choices import Choices
from grammarbt_qlearning.imitation import Imitation
from grammarbt_qlearning.parameters import QLearningParameters
from grammarbt_qlearning.search import TRUSTED, QLearning

PUZZLE = letters()
CHOICES = Choices(States(PUZZLE.grammar))
MODEL = parse_tree(PUZZLE.grammar, parse("?( [a] [b] [c] [b] [a] )"))


def decisions(derivation):
    """The nonterminals of a derivation that leave a choice, and the options chosen."""
    walk, found = CHOICES.states.walk(), []
    while (state := walk.state) is not None:
        option = CHOICES.first(state, derivation[len(walk.derivation) :])
        if len(CHOICES.options(state)) > 1:
            found.append((state.symbol, option))
        for production in option:
            walk.take(production)
    return found


def imitated(seed, odd=None):
    """The names of the leaves that come of imitating the model, with the lowest way out where it says nothing."""
    imitation = Imitation(decisions(MODEL), CHOICES, np.random.default_rng(seed))
    imitation.until_odd = imitation.until_odd if odd is None else odd
    walk = CHOICES.states.walk()
    while (state := walk.state) is not None:
        options = CHOICES.options(state)
        option = options[0] if len(options) == 1 else imitation.option(state) or CHOICES.lowest(state)
        for production in option:
            walk.take(production)
    return "".join(leaf.name for leaf in leaves(CHOICES.states.tree(tuple(walk.derivation))))


def searcher(puzzle, **parameters):
    return QLearning(puzzle.context(budget=800), QLearningParameters(**parameters))


@pytest.mark.parametrize("seed", range(5))
def test_without_the_odd_decision_it_is_the_same_tree(seed):
    assert imitated(seed, odd=1_000) == "abcba"


def test_the_odd_decision_replaces_an_option_or_goes_before_it_or_changes_how_many_there_are():
    found = {imitated(seed) for seed in range(300)}
    assert {"aacba", "abcca"} <= found  # another letter in the second place, and in the fourth
    assert {"babca", "aabca"} <= found  # one before the first, and before the second; the list is as long as it was
    assert {"abc", "abcb", "abcbaa"} <= found


def test_more_errands_are_run_with_imitation_than_without():
    puzzle = errands()
    means = [
        np.mean([puzzle.value(one.tree) for one in puzzle.drive(searcher(puzzle, imitation=share), 800)[-200:]])
        for share in (0.0, 0.8)
    ]
    assert means[1] > means[0]


def test_a_tree_is_not_imitated_on_a_single_lucky_return():
    found = searcher(PUZZLE)
    PUZZLE.drive(found, 400)
    score, derived = found.strategy.best
    assert score.derivation == derived.derivation
    assert score.episodes >= TRUSTED
    assert PUZZLE.value(CHOICES.states.tree(score.derivation)) > 3


def test_where_scenarios_are_alike_one_return_is_enough():
    exact = evolve(PUZZLE, noise=0.0)
    found = searcher(exact)
    exact.drive(found, 400)
    assert found.strategy.scorer.alike
    assert found.strategy.best[0].mean == max(one.mean for one in found.strategy.scorer.scores.values())


def test_without_imitation_no_tree_is_the_best_and_none_is_simulated_again_for_it():
    found = searcher(PUZZLE, imitation=0.0)
    assert all(one.stop - one.start <= 2 for one in PUZZLE.drive(found, 400))
    assert found.strategy.best is None


def test_a_start_tree_is_what_is_imitated_first():
    found = QLearning(PUZZLE.context(start=PUZZLE.solution), QLearningParameters(imitation=1.0))
    seen = [PUZZLE.value(one.tree) for one in PUZZLE.drive(found, 100)]
    assert np.mean(seen) > PUZZLE.value(PUZZLE.solution) - 2
