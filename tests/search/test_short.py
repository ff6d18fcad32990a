"""Sub-trees that fill open places stay within all constraints, whatever stands on both sides of them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.errors import GrammarError
from grammarbt.search import Moves, ShortFirst, States
from grammarbt.search.loops import Loops

OWN = ("lists", "unique", "pairs", "nested", "counted", "scopes")


@pytest.fixture(scope="module", params=OWN)
def short(request, grammars):
    return ShortFirst(States(grammars[request.param]), 0.5)


def is_legal(grammar, derivation):
    try:
        grammar.derive(derivation)
    except GrammarError:
        return False
    return True


@settings(max_examples=40)
@given(seed=st.integers(0, 2**32))
def test_an_opened_place_is_filled_within_the_constraints(short, seed):
    rng = np.random.default_rng(seed)
    tree = Moves(short.grammar, short.states).tree(short.sample(rng))
    nodes = range(1, len(tree.steps))
    for node in rng.choice(nodes, min(4, len(nodes)), replace=False) if nodes else ():
        found = short.complete(tree.replaced(int(node), (None,)), rng)
        assert found is None or is_legal(short.grammar, found)


@settings(max_examples=40)
@given(seed=st.integers(0, 2**32))
def test_a_whole_derivation_is_completed_if_and_only_if_the_language_has_it(short, seed):
    rng = np.random.default_rng(seed)
    moves = Moves(short.grammar, short.states)
    tree, other = moves.tree(short.sample(rng)), moves.tree(short.sample(rng))
    for node, symbol in enumerate(tree.symbols):
        for source in other.by_symbol.get(symbol, ()):
            mixed = tree.replaced(node, other.below(source))
            assert short.complete(mixed, rng) == (mixed if is_legal(short.grammar, mixed) else None)


def test_what_is_no_derivation_is_not_completed(short):
    rng = np.random.default_rng(0)
    derivation = short.sample(rng)
    for broken in (
        derivation[:-1],
        (*derivation, 0),
        (*derivation, None),
        (),
        (len(short.grammar.productions) - 1,) * 3,
    ):
        assert short.complete(broken, rng) is None


def test_two_open_places_do_not_take_the_same_leaf(grammars):
    short, rng = ShortFirst(States(grammars["unique"]), 0.5), np.random.default_rng(1)
    tree = max((Moves(short.grammar).tree(short.sample(rng)) for _ in range(50)), key=lambda tree: len(tree.steps))
    actions = [
        node for node, end in enumerate(tree.ends) if end == node + 1 and len(tree.by_symbol[tree.symbols[node]]) > 1
    ]
    template = tuple(None if node in actions else step for node, step in enumerate(tree.steps))
    found = [short.complete(template, rng) for _ in range(50)]
    assert template.count(None) > 1
    assert any(found)
    assert all(is_legal(short.grammar, derivation) for derivation in found if derivation is not None)


def test_a_loop_leads_from_a_nonterminal_back_to_itself(short):
    grammar, loops = short.grammar, Loops(short.grammar)
    for symbol in grammar.by_lhs:
        for before, behind in loops.of(symbol):
            pending = [symbol]
            for production in before:
                lhs = pending.pop()
                if production is not None:
                    assert grammar.productions[production].lhs == lhs
                    pending += grammar.parts[production][::-1]
            assert pending.pop() == symbol
            assert len(pending) == len(behind)
