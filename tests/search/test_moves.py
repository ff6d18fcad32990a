"""Moves stay in the language, whatever the grammar, and reach what they should."""

from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import children, leaves
from grammarbt.search import IdleElements, Moves

KINDS = ("regenerate", "insert", "delete", "reorder")


@pytest.fixture(scope="session")
def moves_of(grammars):
    return {name: Moves(grammar) for name, grammar in grammars.items()}


def drawn(moves_of, data):
    return moves_of[data.draw(st.sampled_from(sorted(moves_of)))]


def sampled(moves, rng):
    return moves.tree(moves.grammar.sample(rng))


@settings(deadline=None, max_examples=60)  # what a grammar's first states cost is not what is tested
@given(data=st.data(), kind=st.sampled_from(KINDS), seed=st.integers(0, 2**32))
def test_every_move_ends_in_another_derivation_of_the_language(moves_of, data, kind, seed):
    moves, rng = drawn(moves_of, data), np.random.default_rng(seed)
    tree = sampled(moves, rng)
    found = getattr(moves, kind)(tree, rng)
    if found is not None:
        assert found != tree.steps or kind == "delete"
        moves.grammar.derive(found)


@settings(deadline=None, max_examples=60)  # what a grammar's first states cost is not what is tested
@given(data=st.data(), seed=st.integers(0, 2**32))
def test_crossing_over_ends_in_the_language(moves_of, data, seed):
    moves, rng = drawn(moves_of, data), np.random.default_rng(seed)
    found = moves.cross(sampled(moves, rng), sampled(moves, rng), rng)
    if found is not None:
        moves.grammar.derive(found)


@settings(deadline=None, max_examples=60)  # what a grammar's first states cost is not what is tested
@given(data=st.data(), seed=st.integers(0, 2**32))
def test_the_tree_of_a_derivation_has_the_derivation_as_its_sub_tree(moves_of, data, seed):
    moves = drawn(moves_of, data)
    tree = sampled(moves, np.random.default_rng(seed))
    assert tree.below(0) == tree.steps
    for node in range(len(tree.steps)):
        moves.grammar.derive(tree.below(node), tree.symbols[node])
        expected = [s for s in moves.grammar.productions[tree.steps[node]].rhs if moves.grammar.is_nonterminal(s)]
        assert [tree.symbols[child] for child in tree.children(node)] == expected


def spelled(moves, derivation):
    return moves.grammar.tree(moves.grammar.derive(derivation))


def names(tree):
    return "".join(leaf.name for leaf in children(tree))


@pytest.fixture
def abc(moves_of):
    """The list of a, b and e, in a language of lists with at least two actions."""
    moves = moves_of["lists"]
    found = (d for d, w in moves.grammar.enumerate() if names(moves.grammar.tree_of(w)) == "abe")
    return moves, moves.tree(next(found))


def reached(kind, moves, tree, n=600):
    rng = np.random.default_rng(0)
    found = [getattr(moves, kind)(tree, rng) for _ in range(n)]
    return {names(spelled(moves, derivation)) for derivation in found}


def test_delete_reaches_every_element(abc):
    assert reached("delete", *abc) == {"ab", "ae", "be"}


def test_insert_reaches_every_place(abc):
    expected = {word[:at] + new + word[at:] for word in ["abe"] for at in range(4) for new in "abehi"}
    assert reached("insert", *abc) == expected


def test_reorder_reaches_every_place(abc):
    assert reached("reorder", *abc) == {"bae", "bea", "aeb", "eab"}


def test_insert_finds_the_one_element_that_is_not_used_yet(moves_of):
    moves, rng = moves_of["unique"], np.random.default_rng(0)
    words = (d for d, w in moves.grammar.enumerate() if len(leaves(moves.grammar.tree_of(w))) == 4)
    for derivation in islice(words, 20):
        tree = spelled(moves, derivation)
        found = spelled(moves, moves.insert(moves.tree(derivation), rng))
        assert len({*leaves(found)} - {*leaves(tree)}) == 1
        assert len(leaves(found)) == 5


def test_the_shortest_list_cannot_lose_an_element(abc):
    moves, _ = abc
    rng = np.random.default_rng(0)
    shortest = next(d for d, w in moves.grammar.enumerate() if len(children(moves.grammar.tree_of(w))) == 2)
    assert moves.delete(moves.tree(shortest), rng) is None


def test_regenerating_a_node_leaves_the_others(abc):
    moves, tree = abc
    rng = np.random.default_rng(0)
    last = len(tree.steps) - 1
    found = {names(spelled(moves, moves.regenerate(tree, rng, last))) for _ in range(100)}
    assert found == {"aba", "abb", "abh", "abi"}


def test_the_same_stream_makes_the_same_moves(abc):
    moves, tree = abc
    first, second = ([moves.insert(tree, rng) for _ in range(20)] for rng in map(np.random.default_rng, (5, 5)))
    assert first == second


def test_elements_that_were_never_ticked_are_taken_away(abc):
    moves, tree = abc
    rng = np.random.default_rng(0)
    assert names(spelled(moves, IdleElements(moves).removed(tree, (4, 0, 1), rng).steps)) == "ae"
    assert IdleElements(moves).removed(tree, (4, 2, 1), rng) == tree


def test_what_the_language_needs_stays_though_it_was_never_ticked(abc):
    moves, tree = abc
    assert len(names(spelled(moves, IdleElements(moves).removed(tree, (4, 0, 0), np.random.default_rng(0)).steps))) == 2
