"""What tells two trees apart, replayed on the trees."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import Condition, Status, format_leaf, parse
from grammarbt.bt.canonical import behave_alike, none_pure
from grammarbt.bt.compare import Answer, difference
from grammarbt.errors import DomainError


class DoneError(Exception):
    """The tick has come to the action that the scenario ends with."""


def replay(tree, answers, others, interpret):
    """What the tree does after the given answers; conditions not named say `others`."""
    worlds, actions = [{}], []
    for answer in answers:
        if answer.leaf.startswith("("):
            worlds[-1][answer.leaf] = answer.status
        else:
            actions.append(answer)
            worlds.append({})
    asked = []

    def ask(leaf):
        if isinstance(leaf, Condition):
            return worlds[len(asked)].get(format_leaf(leaf), others)
        if len(asked) == len(actions):
            raise DoneError(format_leaf(leaf))
        asked.append(leaf)
        assert actions[len(asked) - 1].leaf == format_leaf(leaf)
        return actions[len(asked) - 1].status

    try:
        status = interpret(tree, ask)
    except DoneError as done:
        return f"ticks {done}"
    return {Status.RUNNING: "ends running"}.get(status, f"ends with {status.name.lower()}")


@settings(max_examples=300, deadline=None)
@given(data=st.data())
def test_a_difference_can_be_replayed_on_both_trees(data, small_trees, interpret):
    one, other = data.draw(small_trees), data.draw(small_trees)
    found = difference(one, other)
    assert (found is None) == behave_alike(one, other)
    for others in (Status.SUCCESS, Status.FAILURE):
        if found:
            assert replay(one, found.answers, others, interpret) == found.one
            assert replay(other, found.answers, others, interpret) == found.other
            assert found.one != found.other


def test_a_difference_is_a_shortest_one():
    one, other = parse("?( →( (c) (d) [a] ) [b] )"), parse("?( →( (c) [a] ) [b] )")
    found = difference(one, other)
    assert found.answers == (Answer("(c)", Status.SUCCESS), Answer("(d)", Status.FAILURE))
    assert (found.one, found.other) == ("ticks [b]", "ticks [a]")


def test_actions_that_answer_alike_but_go_on_differently_differ():
    found = difference(parse("→( [a] [b] )"), parse("→( [a] [a] )"))
    assert found.answers == (Answer("[a]", Status.SUCCESS),)
    running = difference(parse("‖1( [a] [b] )"), parse("?( [a] [b] )"))
    assert running.answers == (Answer("[a]", Status.RUNNING),)


def test_impure_conditions_are_asked_again():
    one, other = parse("→( (c) (c) )"), parse("(c)")
    assert difference(one, other) is None
    assert difference(one, other, none_pure).answers == (Answer("(c)", Status.SUCCESS),)


def test_trees_too_tangled_to_compare_are_an_error():
    pairs = " ".join(f"→( (a{i}) (b{i}) )" for i in range(40))
    with pytest.raises(DomainError, match="too large to be compared"):
        difference(parse(f"?( {pairs} [x] )"), parse("[x]"))
