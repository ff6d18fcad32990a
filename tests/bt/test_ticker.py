"""Fast ways of ticking against walking the tree."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import Action, Condition, Not, Parallel, Sequence, Status, flatten, format_tree, leaves, parse, tick
from grammarbt.bt.generate import compile_source, generate_source
from grammarbt.bt.linked import ticker


class Recording:
    """Answers that remember what was asked."""

    def __init__(self, answers):
        self.answers, self.asked = answers, []

    def __getitem__(self, occurrence):
        self.asked.append(occurrence)
        return int(self.answers[occurrence])


@settings(max_examples=300, deadline=None)
@given(data=st.data())
def test_flat_steps_and_generated_source_ask_and_answer_as_the_flat_tree_does(data, small_trees):
    tree = data.draw(small_trees)
    answers = [Status(data.draw(st.integers(0, 2 if isinstance(leaf, Action) else 1))) for leaf in leaves(tree)]
    order = []
    status = tick(flatten(tree), lambda _, occurrence: order.append(occurrence) or answers[occurrence])
    for way in (ticker(flatten(tree)), compile_source(tree)):
        recording = Recording(answers)
        assert way(recording) is status
        assert recording.asked == order


def nested(depth):
    tree = Action("a")
    for level in range(depth):
        tree = Sequence((Condition("c"), tree)) if level % 3 == 0 else Parallel((tree, Action("b")), 1 + level % 2)
        tree = Not(tree) if level % 5 == 0 else tree
    return tree


@pytest.mark.parametrize("depth", [1, 60, 61, 150])
def test_deep_trees_are_generated_too(depth):
    tree = nested(depth)
    wanted = ticker(flatten(tree))
    generated = compile_source(tree)
    for number in range(30):
        answers = [(number * (at + 1)) % 3 if isinstance(leaf, Action) else 1 for at, leaf in enumerate(leaves(tree))]
        assert generated(answers) is wanted(answers)


def test_negations_as_deep_as_allowed_are_generated():
    tree = parse("!(" * 255 + "[a]" + ")" * 255)
    assert [compile_source(tree)([status]) for status in (0, 1, 2)] == [Status.SUCCESS, Status.FAILURE, Status.RUNNING]


def test_no_name_gets_into_the_source():
    name = "'\"; import os #"
    source = generate_source(parse(f"?( [{name}] ({name}) )"))
    assert "import" not in source
    assert name in format_tree(parse(f"[{name}]"))


def test_statuses_may_be_given_instead_of_numbers():
    tree = parse("?( (c) [a] )")
    answers = [Status.FAILURE, Status.RUNNING]
    assert ticker(flatten(tree))(answers) is compile_source(tree)(answers) is Status.RUNNING


def test_parallel_nodes_as_deep_as_allowed_are_generated():
    tree = Action("a")
    for _ in range(255):
        tree = Parallel((tree,), 1)
    for status in Status:
        assert compile_source(tree)([status]) is ticker(flatten(tree))([status]) is status


def test_a_long_row_of_actions_is_generated():
    tree = Sequence(tuple(Action(f"a{number}") for number in range(1_000)))
    assert compile_source(tree)([1] * 999 + [2]) is Status.RUNNING
