"""A unit production is no decision of its own."""

import numpy as np
import pytest

from grammarbt.bt import leaves
from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt.search import Evaluation, SearchContext, States
from grammarbt_qlearning.choices import Choices
from grammarbt_qlearning.parameters import QLearningParameters
from grammarbt_qlearning.search import QLearning

VOCABULARY = Vocabulary((Group("g", tuple(map(ActionType, "abc")), (ConditionType("x"),)),))
GRAMMAR = """
%declare ACTION CONDITION
%limit nodes 15
start: list
list: "→" "(" part part ")"
part: ACTION @ 6 | test | list
test: "?" "(" CONDITION part ")"
"""

PAIR = """
%declare ACTION
start: "→" "(" part part ")"
part: ACTION
"""


@pytest.fixture(scope="module")
def grammar():
    return bind(load_grammar(Source("parts.grammar", GRAMMAR)), VOCABULARY)


def test_leaves_and_lists_are_options_side_by_side(grammar):
    states = States(grammar)
    choices = Choices(states)
    walk = states.walk()
    for production in choices.options(walk.state)[0]:
        walk.take(production)
    options = choices.options(walk.state)
    assert len(options) == len(set(options)) == 5
    action, test, sequence = walk.state.productions
    assert [option[0] for option in options] == [action, action, action, test, sequence]


def test_options_make_exactly_the_derivations_of_the_language(grammar):
    choices = Choices(States(grammar))
    rng = np.random.default_rng(0)
    for _ in range(300):
        derivation = grammar.sample(rng)
        walk = choices.states.walk()
        while (state := walk.state) is not None:
            for production in choices.first(state, derivation[len(walk.derivation) :]):
                assert walk.take(production)
        assert tuple(walk.derivation) == derivation


def test_options_are_drawn_as_often_as_their_productions(grammar):
    choices = Choices(States(grammar))
    walk = choices.states.walk()
    for production in choices.options(walk.state)[0]:
        walk.take(production)
    rng = np.random.default_rng(0)
    drawn = [choices.draw(walk.state, rng) for _ in range(4_000)]
    shares = [drawn.count(option) / len(drawn) for option in choices.options(walk.state)]
    assert shares == pytest.approx([2 / 8, 2 / 8, 2 / 8, 1 / 8, 1 / 8], abs=0.03)


def test_the_lowest_option_ends_a_derivation_soonest(grammar):
    choices = Choices(States(grammar))
    walk = choices.states.walk()
    while (state := walk.state) is not None:
        for production in choices.lowest(state):
            walk.take(production)
    assert len(leaves(choices.states.tree(tuple(walk.derivation)))) == 2


def test_what_is_learned_of_a_leaf_depends_on_its_place():
    """An `a` pays in the first place and a `b` in the second: one value per action, whatever its place, learns neither."""
    pair = bind(load_grammar(Source("pair.grammar", PAIR)), VOCABULARY)
    context = SearchContext(pair, VOCABULARY, np.random.default_rng(0), 300)
    searcher = QLearning(context, QLearningParameters(view="place", imitation=0.0))
    seen = []
    for _ in range(300):
        asked = searcher.ask(1)
        evaluations = list(map(evaluated, asked))
        seen += [names(proposal) for proposal in asked]
        searcher.tell(evaluations)
    assert seen[:100].count("ab") < 35
    assert seen[-100:].count("ab") > 75


def names(proposal):
    return "".join(leaf.name for leaf in leaves(proposal.tree))


def evaluated(proposal):
    """Noise makes a tree worth simulating more than once."""
    first, second = names(proposal)
    noise = [0.1 * np.random.default_rng(scenario).normal() for scenario in range(proposal.start, proposal.stop)]
    return Evaluation(proposal, tuple((first == "a") + (second == "b") + own for own in noise))
