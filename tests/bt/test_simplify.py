"""Smaller trees that behave alike."""

from __future__ import annotations

import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import format_tree, parse
from grammarbt.bt.canonical import behave_alike, none_pure
from grammarbt.bt.simplify import simplify, size

S3_HAND = """?( (task done) →( ?( (cube0 placed) →( [localise] [head up] ?( (have block) →( [tuck] [move to pick0] ) ) [head down]
[pick] [move to place] [place] ) ) ?( (cube1 placed) →( [localise] [head up] ?( (have block) →( [tuck] [move to pick1] ) )
[head down] [pick] [move to place] [place] ) ) ) )"""


@settings(max_examples=100, deadline=None)
@given(data=st.data())
def test_the_simplified_tree_behaves_alike_and_is_no_larger(data, small_trees):
    tree = data.draw(small_trees)
    simple = simplify(tree)
    assert behave_alike(simple, tree)
    assert size(simple) <= size(tree)


@pytest.mark.parametrize(
    ("tree", "simple"),
    [
        ("?( →( [a] ) )", "[a]"),
        ("!( !( [a] ) )", "[a]"),
        ("→( [a] →( [b] →( [c] [d] ) ) )", "→( [a] [b] [c] [d] )"),
        ("→( !(c) !(d) !(e) )", "!(?( (c) (d) (e) ))"),
        ("!( ?( !(c) !(d) ) )", "→( (c) (d) )"),
        ("?( (c) →( !(c) [a] ) )", "?( (c) [a] )"),
        ("→( (c) ?( (c) [a] ) [b] )", "→( (c) [b] )"),
        ("‖1( (c) (d) (c) )", "?( (c) (d) )"),
        ("‖2( (c) (d) [a] [b] )", "‖2( (c) (d) [a] [b] )"),
        ("?( →( (c) (d) ) →( (c) (e) ) [a] )", "?( →( (c) ?( (d) (e) ) ) [a] )"),
        ("→( ?( (d) (c) ) ?( (e) (c) ) [a] )", "→( ?( →( (d) (e) ) (c) ) [a] )"),
        ("→( [a] [a] )", "→( [a] [a] )"),
        ("?( →( (c) [a] ) →( (c) [b] ) )", "?( →( (c) [a] ) →( (c) [b] ) )"),
    ],
)
def test_these_become(tree, simple):
    assert behave_alike(simplify(parse(tree)), parse(simple))
    assert format_tree(simplify(parse(tree))) == simple


def test_what_holds_only_for_pure_conditions_is_left_alone_for_others():
    assert simplify(parse("→( (c) (c) [a] )")) == parse("→( (c) [a] )")
    assert simplify(parse("→( (c) (c) [a] )"), none_pure) == parse("→( (c) (c) [a] )")


def test_a_large_tree_is_simplified_within_seconds():
    plain = parse(f"?( {S3_HAND} {S3_HAND} )")
    begin = time.process_time()
    simple = simplify(parse(f"?( !( !( {S3_HAND} ) ) ?( →( {S3_HAND} ) ) )"))
    assert time.process_time() - begin < 5
    assert size(simple) <= size(simplify(plain)) < size(plain)
