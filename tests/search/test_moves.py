"""Moves stay in the language, whatever the grammar, and reach what they should."""

from itertools import islice

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grammarbt.bt import children, leaves
from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import Source, bind, load_grammar, shipped_grammars
from grammarbt.search import Moves

VOCABULARY = Vocabulary(
    (
        Group("g1", (ActionType("a"), ActionType("b")), (ConditionType("c"), ConditionType("d"))),
        Group("g2", (ActionType("e"),), (ConditionType("f"),)),
        Group("g3", (ActionType("h"), ActionType("i")), (ConditionType("j"),)),
    )
)
LISTS = '%declare ACTION CONDITION\n%limit nodes 9\nstart: "?" "(" ACTION ACTION+ ")"\n'
UNIQUE = (
    '%declare ACTION CONDITION\n%unique ACTION in start\nstart: "?" "(" ACTION* sure ")"\nsure: "→" "(" ACTION ")"\n'
)
PAIRS = '%declare ACTION CONDITION\nstart: "?" "(" pairs ")"\npairs: pairs CONDITION ACTION | ACTION\n'
NESTED = (
    '%declare ACTION CONDITION\n%limit depth 5\nstart: ACTION | "→" "(" CONDITION start ")" | "?" "(" start start ")"\n'
)
COUNTED = '%declare ACTION CONDITION\nstart: "?" "(" CONDITION~2..4 ACTION? ACTION ")"\n'
OWN = {"lists": LISTS, "unique": UNIQUE, "pairs": PAIRS, "nested": NESTED, "counted": COUNTED}


def bound(name):
    source = Source(f"{name}.grammar", OWN[name]) if name in OWN else shipped_grammars()[name]
    return bind(load_grammar(source), VOCABULARY)


MOVES = {name: Moves(bound(name)) for name in (*OWN, *shipped_grammars())}
KINDS = ("regenerate", "insert", "delete", "reorder")


def sampled(moves, rng):
    return moves.tree(moves.grammar.sample(rng))


@given(st.sampled_from(sorted(MOVES)), st.sampled_from(KINDS), st.integers(0, 2**32))
def test_every_move_ends_in_another_derivation_of_the_language(name, kind, seed):
    moves, rng = MOVES[name], np.random.default_rng(seed)
    tree = sampled(moves, rng)
    found = getattr(moves, kind)(tree, rng)
    if found is not None:
        assert found != tree.steps or kind == "delete"
        moves.grammar.derive(found)


@given(st.sampled_from(sorted(MOVES)), st.integers(0, 2**32))
def test_crossing_over_ends_in_the_language(name, seed):
    moves, rng = MOVES[name], np.random.default_rng(seed)
    found = moves.cross(sampled(moves, rng), sampled(moves, rng), rng)
    if found is not None:
        moves.grammar.derive(found)


@given(st.sampled_from(sorted(MOVES)), st.integers(0, 2**32))
def test_the_tree_of_a_derivation_has_the_derivation_as_its_sub_tree(name, seed):
    moves = MOVES[name]
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
def abc():
    """The list of a, b and e, in a language of lists with at least two actions."""
    moves = MOVES["lists"]
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


def test_insert_finds_the_one_element_that_is_not_used_yet():
    moves, rng = MOVES["unique"], np.random.default_rng(0)
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
