"""Leaves that can never run."""

from __future__ import annotations

from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import Action, Status, flatten, leaves, parse, tick
from grammarbt.bt.canonical import none_pure
from grammarbt.bt.check import dead_leaves

SUCCESS, FAILURE, RUNNING = Status.SUCCESS, Status.FAILURE, Status.RUNNING


def dead(text, results=None, *more):
    named = {Action(name): set(found) for name, found in (results or {}).items()}
    return [(leaf.leaf.name, leaf.occurrence) for leaf in dead_leaves(parse(text), named, *more)]


@pytest.mark.parametrize(
    ("text", "results", "expected"),
    [
        ("?( [a] [b] )", {}, []),
        ("?( [a] [b] )", {"a": [SUCCESS, RUNNING]}, [("b", 1)]),
        ("→( [a] [b] )", {"a": [RUNNING]}, [("b", 1)]),
        ("→( [a] [b] )", {"a": [FAILURE, RUNNING]}, [("b", 1)]),
        ("→( !([a]) [b] )", {"a": [FAILURE]}, []),
        ("‖1( [a] [b] )", {"a": [RUNNING]}, []),
        ("‖1( [a] [b] )", {"a": [SUCCESS]}, [("b", 1)]),
        ("?( →( (c) !(c) [a] ) [b] )", {}, [("a", 2)]),
        ("?( →( (c) [x] !(c) [a] ) [b] )", {}, []),
        ("?( (c) →( !(c) [a] ) [b] )", {"a": [SUCCESS]}, [("b", 3)]),
        ("?( (c) (d) (c) )", {}, []),
    ],
)
def test_these_are_dead(text, results, expected):
    assert dead(text, results) == expected


def test_conditions_that_may_change_at_any_time_exclude_nothing():
    assert dead("→( (c) !(c) [a] )", {}, none_pure) == []


@settings(max_examples=100, deadline=None)
@given(data=st.data())
def test_dead_leaves_are_those_that_no_answers_reach(data, small_trees):
    tree = data.draw(small_trees.filter(lambda tree: len(leaves(tree)) <= 6))
    some = st.sets(st.sampled_from(list(Status)), min_size=1)
    results = {Action("a"): data.draw(some), Action("b"): data.draw(some)}
    possible = [results[leaf] if isinstance(leaf, Action) else {SUCCESS, FAILURE} for leaf in leaves(tree)]
    visited = set()
    for answers in product(*possible):
        tick(flatten(tree), lambda _, at, answers=answers: visited.add(at) or answers[at])
    expected = sorted(set(range(len(leaves(tree)))) - visited)
    assert [leaf.occurrence for leaf in dead_leaves(tree, results, none_pure)] == expected


def test_many_conditions_do_not_explode():
    pairs = " ".join(f"?( (a{i}) (b{i}) )" for i in range(60))
    assert dead(f"→( {pairs} [x] )", {}) == []
