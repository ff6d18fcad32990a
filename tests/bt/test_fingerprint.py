"""Fingerprints against the canonical form, which is exact."""

from __future__ import annotations

import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import Fallback, Sequence, parse
from grammarbt.bt.canonical import all_pure, canonical_key, none_pure
from grammarbt.bt.fingerprint import Fingerprints, text_fingerprint


def only_d(condition):
    return condition.name == "d"


@pytest.mark.parametrize("is_pure", [all_pure, none_pure, only_d])
@settings(max_examples=300, deadline=None)
@given(data=st.data())
def test_fingerprints_are_equal_exactly_when_canonical_keys_are(data, small_trees, is_pure):
    one, other = data.draw(small_trees), data.draw(small_trees)
    fingerprint = Fingerprints(is_pure)
    for left, right in ((one, other), (Sequence((one, other)), Sequence((one, one))), (one, Fallback((one, other)))):
        alike = canonical_key(left, is_pure) == canonical_key(right, is_pure)
        assert (fingerprint(left) == fingerprint(right)) == alike


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("→( (c) (d) [a] )", "→( (d) (c) [a] )"),
        ("→( (c) ?( (c) [a] ) )", "(c)"),
        ("?( →( (c) !(c) ) [a] )", "[a]"),
        ("→( ?( (c) !(c) ) ?( (d) [a] ) )", "?( (d) [a] )"),
        ("‖1( (c) (d) )", "?( (c) (d) )"),
        ("!( →( [a] [b] ) )", "?( !([a]) !([b]) )"),
    ],
)
def test_a_tree_that_asks_twice_shares_the_fingerprint_of_one_that_asks_once(one, other):
    fingerprint = Fingerprints(all_pure)
    assert fingerprint(parse(one)) == fingerprint(parse(other))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("→( [a] (c) [b] )", "?( →( (c) [a] [b] ) →( !(c) [a] (x) ) )"),
        ("→( [a] !([b]) )", "→( [b] !([a]) )"),
        ("→( [a] ?( [a] [b] ) )", "?( →( [a] [b] ) [a] )"),
        ("[c]", "(c)"),
        ("→( (c) [a] (c) )", "→( (c) [a] )"),
    ],
)
def test_what_an_action_separates_is_not_mixed_up(one, other):
    fingerprint = Fingerprints(all_pure)
    assert fingerprint(parse(one)) != fingerprint(parse(other))


def test_an_impure_condition_is_neither_moved_nor_merged():
    fingerprint = Fingerprints(only_d)
    assert fingerprint(parse("→( (c) (c) [a] )")) != fingerprint(parse("→( (c) [a] )"))
    assert fingerprint(parse("→( (c) (d) [a] )")) != fingerprint(parse("→( (d) (c) [a] )"))
    assert fingerprint(parse("→( (d) (d) [a] )")) == fingerprint(parse("→( (d) [a] )"))


def test_conditions_in_an_unlucky_order_are_no_trouble():
    pairs = [f"→( (a{i}) (b{i}) )" for i in range(40)]
    shuffled = [*pairs[1::3], *pairs[2::3], *pairs[0::3]]
    fingerprint = Fingerprints(all_pure)
    begin = time.process_time()
    one, other = (fingerprint(parse(f"?( {' '.join(order)} [x] )")) for order in (pairs, shuffled))
    assert time.process_time() - begin < 1
    assert one == other
    assert fingerprint(parse(f"?( {' '.join(pairs[1:])} [x] )")) != one


def test_a_tree_too_tangled_to_ask_nothing_twice_is_told_apart_leaf_by_leaf():
    tangled, plain = (parse(f"→( {' '.join(f'(c{i})' for i in range(count))} (c0) )") for count in (300, 3))
    assert Fingerprints(all_pure)(tangled) == Fingerprints(none_pure)(tangled)
    assert Fingerprints(all_pure)(plain) != Fingerprints(none_pure)(plain)


def test_one_condition_more_in_a_large_tree_makes_a_difference():
    pairs = " ".join(f"→( (a{i}) (b{i}) )" for i in range(40))
    fingerprint = Fingerprints(all_pure)
    assert fingerprint(parse(f"?( {pairs} (a0) [x] )")) != fingerprint(parse(f"?( {pairs} (a1) [x] )"))


def test_thousands_of_conditions_are_no_trouble():
    names = [f"(c{i})" for i in range(5000)]
    fingerprint = Fingerprints(all_pure)
    assert fingerprint(parse(f"→( {' '.join(names)} )")) == fingerprint(parse(f"→( {' '.join(reversed(names))} )"))


def test_fingerprints_are_the_same_in_every_process(printed):
    texts = ["?( →( (c) (b) [x] ) →( !(d) [y] ) [z] )", "?( →( (c) (b) [x] ) →( !(b) [y] ) [z] )"]
    imports = "from grammarbt.bt import all_pure, parse; from grammarbt.bt.fingerprint import Fingerprints"
    program = f"{imports}; print(*[Fingerprints(all_pure)(parse(text)).hex() for text in {texts!r}])"
    fingerprint = Fingerprints(all_pure)
    assert printed(program) == {" ".join(fingerprint(parse(text)).hex() for text in texts)}


def test_the_fingerprint_of_a_text_tells_trees_that_behave_alike_apart():
    assert text_fingerprint("→( [a] )") != text_fingerprint("[a]")
