"""A walk offers what the grammar offers, whatever the constraints."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.search import States


@pytest.fixture(scope="session")
def states(grammars):
    return {name: States(grammar) for name, grammar in grammars.items()}


@settings(deadline=None, max_examples=50)  # what a grammar's first states cost is not what is tested
@given(data=st.data(), seed=st.integers(0, 2**32))
def test_a_walk_offers_the_legal_productions_of_the_leftmost_form(grammars, states, data, seed):
    name = data.draw(st.sampled_from(sorted(grammars)))
    grammar, walk, rng = grammars[name], states[name].walk(), np.random.default_rng(seed)
    form = grammar.start()
    while walk.state is not None:
        assert walk.state.productions == grammar.legal(form)
        production = int(rng.choice(walk.state.productions))
        form = grammar.apply(form, production)
        assert walk.take(production)
    assert grammar.is_word(form)
    assert grammar.derive(tuple(walk.derivation)).symbols == tuple(s for s in form.symbols if s >= 0)


@settings(deadline=None, max_examples=50)  # what a grammar's first states cost is not what is tested
@given(data=st.data(), seed=st.integers(0, 2**32))
def test_a_whole_derivation_spells_its_tree(grammars, states, data, seed):
    name = data.draw(st.sampled_from(sorted(grammars)))
    grammar = grammars[name]
    derivation = states[name].complete((None,), np.random.default_rng(seed))
    assert states[name].tree(derivation) == grammar.tree(grammar.derive(derivation))


def test_illegal_steps_are_refused_and_leave_the_walk_as_it_was(states, grammars):
    walk = states["lists"].walk()
    assert not walk.take(len(grammars["lists"].productions) - 1)
    assert walk.derivation == []
    walk.grow(np.random.default_rng(0))
    assert not walk.take(0)
