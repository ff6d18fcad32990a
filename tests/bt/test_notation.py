"""The one-line notation, both ways."""

from __future__ import annotations

import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import (
    MAX_DEPTH,
    Action,
    Condition,
    Fallback,
    Not,
    Parallel,
    Sequence,
    depth,
    format_tree,
    leaves,
    parse,
    rebuild,
)
from grammarbt.errors import NotationError


@settings(max_examples=300, deadline=None)
@given(data=st.data())
def test_printing_and_parsing_round_trip(data, any_trees):
    tree = data.draw(any_trees)
    assert parse(format_tree(tree)) == tree


@settings(max_examples=200, deadline=None)
@given(text=st.text("?→->!‖|2()[]ab=, \t\n", max_size=40))
def test_any_text_is_a_tree_or_an_error_with_a_column(text):
    if problem := _problem(text):
        assert "column" in problem
    else:
        assert parse(format_tree(parse(text))) == parse(text)


def _problem(text):
    try:
        parse(text)
    except NotationError as error:
        return error.message
    return None


def test_the_papers_tree_reads_as_it_looks():
    text = "?( →( (mine found) (is armed) [disarm] ) →( !(carrying object) [pick up] ) [random walk] )"
    mines = Sequence((Condition("mine found"), Condition("is armed"), Action("disarm")))
    objects = Sequence((Not(Condition("carrying object")), Action("pick up")))
    tree = Fallback((mines, objects, Action("random walk")))
    assert parse(text) == tree
    assert format_tree(tree) == text


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("?([a][b])", " ?  (\n[ a ]\t[b] ) "),
        ("->( [a] (b) )", "→( [a] (b) )"),
        ("||2( [a] (b) )", "‖2( [a] (b) )"),
        ("!((c))", "!(c)"),
        ("!( (c) )", "! ( c )"),
        ("!( !( (c) ) )", "!(!(c))"),
        ("[go to( x = 3 , y=4 )]", "[go to(x=3,y=4)]"),
    ],
)
def test_these_spellings_read_alike(one, other):
    assert parse(one) == parse(other)


@pytest.mark.parametrize(
    ("text", "column", "says"),
    [
        ("", 1, "expected a tree"),
        ("?( [a] ", 8, "expected a tree"),
        ("?( [a] ) [b]", 10, "goes on"),
        ("?()", 4, "without children"),
        ("→( [a] ] )", 8, "expected a tree"),
        ("[a", 1, "never closed"),
        ("(a[b])", 1, "never closed"),
        ("[]", 1, "name"),
        ("!( [a] [b] )", 13, "one child"),
        ("‖3( [a] [b] )", 1, "cannot wait for 3"),
        ("‖0( [a] )", 1, "cannot wait for 0"),
        ("[a(x)]", 1, "arguments"),
        ("[a(x=1,x=2)]", 1, "twice"),
        ("[a(x=1)b]", 1, "cannot read the leaf"),
        ("tree", 1, "expected a tree"),
    ],
)
def test_an_error_names_the_column(text, column, says):
    with pytest.raises(NotationError, match=f"{says}.*, at column {column} near") as caught:
        parse(text)
    assert caught.value.hint
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "name", ["", " a", "a ", "a(b", "a]b", "a{b", "a}b", "a\nb", "a\0b", "a\x85b", "a\u2028b", "a\ud800b", "a\uffffb"]
)
def test_these_names_are_refused(name):
    with pytest.raises(NotationError):
        Action(name)


def test_a_tree_may_be_as_deep_as_allowed_and_no_deeper():
    deepest = "!(" * (MAX_DEPTH - 1) + "[a]" + ")" * (MAX_DEPTH - 1)
    assert depth(parse(deepest)) == MAX_DEPTH
    with pytest.raises(NotationError, match="deeper than 256"):
        parse(f"!({deepest})")


@pytest.mark.parametrize(
    "text",
    [
        "?(" * 100_000,
        "(" * 100_000,
        "[" + " " * 100_000 + "(",
        "[a" + " " * 100_000 + "b(c=" + " " * 100_000,
        "‖" + "9" * 100_000 + "( [a] )",
        "?( " + "[a] " * 50_000,
        "!" * 100_000,
    ],
)
def test_hostile_text_is_refused_fast(text):
    begin = time.process_time()
    with pytest.raises(NotationError) as caught:
        parse(text)
    assert time.process_time() - begin < 1
    assert len(str(caught.value)) < 300


def test_rebuilding_changes_every_node():
    tree = parse("?( →( (c) [a] ) !([a]) ‖1( [a] (c) ) )")
    renamed = rebuild(tree, lambda node: Action("b") if node == Action("a") else node)
    assert renamed == parse("?( →( (c) [b] ) !([b]) ‖1( [b] (c) ) )")
    assert leaves(renamed).count(Action("b")) == 3


def test_a_parallel_node_waits_for_a_possible_number():
    with pytest.raises(NotationError):
        Parallel((Action("a"),), 2)
    with pytest.raises(NotationError):
        Fallback(())
