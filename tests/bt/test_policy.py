"""Flat policies against walking the tree."""

from __future__ import annotations

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import (
    Action,
    Condition,
    Parallel,
    Sequence,
    Status,
    canonical_key,
    compile_policy,
    flatten,
    leaves,
    parse,
    tick,
)
from grammarbt.errors import DomainError

ANSWERS = (Status.SUCCESS, Status.FAILURE, Status.RUNNING)


def occurrences(tree):
    """The tree with every leaf renamed to its place, so that a walk tells which leaf it ticks."""
    numbers = iter(range(10_000))
    return _numbered(tree, numbers)


def _numbered(node, numbers):
    if isinstance(node, Action | Condition):
        return type(node)(f"{next(numbers)} {node.name}")
    if hasattr(node, "child"):
        return type(node)(_numbered(node.child, numbers))
    parts = tuple(_numbered(part, numbers) for part in node.children)
    return type(node)(parts, node.successes) if hasattr(node, "successes") else type(node)(parts)


@settings(max_examples=300, deadline=None)
@given(data=st.data())
def test_a_flat_tick_visits_the_leaves_that_a_walk_visits(data, small_trees, interpret):
    tree = data.draw(small_trees)
    script = data.draw(st.lists(st.sampled_from(ANSWERS), min_size=30, max_size=30))
    walked, ticked = [], []

    def answer(kind, visits):
        status = script[len(visits) % len(script)]
        return Status.FAILURE if kind is Condition and status is Status.RUNNING else status

    def walking(leaf):
        status = answer(type(leaf), walked)
        walked.append((int(leaf.name.split()[0]), status))
        return status

    def ticking(leaf, occurrence):
        assert leaves(tree)[occurrence] == leaf
        status = answer(type(leaf), ticked)
        ticked.append((occurrence, status))
        return status

    assert tick(flatten(tree), ticking) == interpret(occurrences(tree), walking)
    assert ticked == walked


def test_entries_are_numbered_in_the_order_of_first_visit():
    flat = flatten(parse("?( →( (c) [a] ) [b] )"))
    assert [entry.occurrence for entry in flat.entries] == [0, 1, 2]
    assert [(entry.on_success, entry.on_failure, entry.on_running) for entry in flat.entries] == [
        (1, 2, -3),
        (-1, 2, -3),
        (-1, -2, -3),
    ]


def test_a_leaf_that_no_tick_reaches_has_no_entry_but_counts_as_occurrence():
    flat = flatten(parse("→( ‖1( [a] !([b]) ) ‖2( [c] !([d]) !([e]) !([f]) [g] ) )"))
    assert flat.occurrences == 7


def test_arrays_say_what_the_entries_say():
    tree = parse("?( →( (c) [a] ) ‖1( [b] (c) ) )")
    index = {Action("a"): 5, Action("b"): 6, Condition("c"): 7}
    policy, flat = compile_policy(tree, index), flatten(tree)
    assert policy.leaf.tolist() == [index[entry.leaf] for entry in flat.entries]
    assert policy.on_failure.tolist() == [entry.on_failure for entry in flat.entries]
    assert policy.on_running.tolist() == [entry.on_running for entry in flat.entries]
    assert policy.leaf.dtype == np.int32
    assert policy.leaf.flags.c_contiguous


def test_an_unknown_leaf_is_an_error_that_offers_the_nearest():
    with pytest.raises(DomainError, match=r"no leaf \[disarn\].*did you mean '\[disarm\]'"):
        compile_policy(parse("[disarn]"), {Action("disarm"): 0})


def test_nested_parallels_end_in_an_error_and_not_in_an_explosion():
    tree = Action("a")
    for _ in range(6):
        tree = Parallel((tree,) * 5, 3)
    begin = time.process_time()
    with pytest.raises(DomainError, match="unroll to more than 100,000 steps"):
        flatten(tree)
    assert time.process_time() - begin < 5


@pytest.mark.parametrize("compiled", [flatten, canonical_key])
def test_a_tree_of_too_many_leaves_is_an_error(compiled):
    tree = Sequence(tuple(Action(f"a{number}") for number in range(100_001)))
    with pytest.raises(DomainError, match="more than 100,000 steps"):
        compiled(tree)


def test_a_parallel_of_many_children_compiles():
    flat = flatten(parse("‖2( " + " ".join(f"[a{i}]" for i in range(300)) + " )"))
    assert flat.occurrences == 300


def test_compiling_a_tree_of_twenty_nodes_takes_less_than_100_microseconds():
    tree = parse("?( →( (a) (b) [x] ) →( !(c) ?( (d) [y] ) [z] ) →( (e) (f) [v] ) [w] →( (g) [u] ) )")
    seconds = []
    for _ in range(300):
        begin = time.process_time()
        flatten(tree)
        seconds.append(time.process_time() - begin)
    assert min(seconds) < 100e-6
