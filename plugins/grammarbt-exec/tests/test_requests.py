"""A request says everything about a tree, three times, and each says the same."""

import json
import re
from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from grammarbt.bt import (
    Action,
    Condition,
    Status,
    compile_policy,
    flatten,
    leaves,
    parse,
    tick,
)
from grammarbt.bt.formats.btcpp import loads
from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.testing import trees_over
from grammarbt_exec.messages import simulation

NAMES = ("a", 'say "policy":1, "id":2', "grüßen", "back\\slash")
VOCABULARY = Vocabulary((Group("g", tuple(map(ActionType, NAMES)), tuple(map(ConditionType, NAMES))),))
ENDS = {-1: Status.SUCCESS, -2: Status.FAILURE, -3: Status.RUNNING}

LEAVES = st.sampled_from([Action(name) for name in NAMES] + [Condition(name) for name in NAMES])

TREES = trees_over(LEAVES, most=8)


def request_for(tree, scenarios=(0,)):
    return json.loads(simulation(compile_policy(tree, VOCABULARY.index), np.array(scenarios, dtype=np.int64)).line)


def tick_table(table, answers):
    """What a program does with the table, written as the reference says."""
    at, ticked = 0, []
    while at >= 0:
        leaf, occurrence, on_success, on_failure, on_running = table[5 * at : 5 * at + 5]
        ticked.append((leaf, occurrence))
        at = {Status.SUCCESS: on_success, Status.FAILURE: on_failure, Status.RUNNING: on_running}[answers[occurrence]]
    return ENDS[at], ticked


@given(TREES, st.randoms(use_true_random=False))
def test_the_table_ticks_as_the_tree_does(tree, random):
    occurrences = list(leaves(tree))
    answers = [
        random.choice([Status.SUCCESS, Status.FAILURE] + [Status.RUNNING] * isinstance(leaf, Action))
        for leaf in occurrences
    ]
    expected = []

    def answer(leaf, occurrence):
        expected.append((VOCABULARY.index[leaf], occurrence))
        return answers[occurrence]

    status = tick(flatten(tree), answer)
    assert tick_table(request_for(tree)["policy"], answers) == (status, expected)


@given(TREES)
def test_notation_xml_and_leaves_are_of_the_same_tree(tree):
    request = request_for(tree)
    assert parse(request["tree"]) == tree
    assert loads(request["btcpp"]) == tree
    assert [parse(leaf) for leaf in request["leaves"]] == list(leaves(tree))


@given(TREES, st.lists(st.integers(0, 2**62), min_size=1, max_size=5))
def test_a_program_without_a_json_reader_finds_the_numbers(tree, scenarios):
    line = simulation(compile_policy(tree, VOCABULARY.index), np.array(scenarios)).line.decode()
    assert line.count("\n") == 1
    for key in ("scenarios", "policy"):
        text = line.split(f'"{key}":[', 1)[1].split("]", 1)[0]
        assert [int(number) for number in text.split(",")] == json.loads(line)[key]
    assert json.loads(line)["scenarios"] == scenarios
    assert int(line.removeprefix('{"id":').split(",", 1)[0]) == json.loads(line)["id"]


def test_the_same_question_has_the_same_id_and_another_one_another():
    tree, other = parse("?( [a] (a) )"), parse("→( [a] (a) )")
    assert request_for(tree)["id"] == request_for(tree)["id"]
    assert len({request_for(tree)["id"], request_for(other)["id"], request_for(tree, (1,))["id"]}) == 3


def test_the_table_in_the_reference_is_that_of_its_tree():
    page = (Path(__file__).parents[3] / "docs" / "reference" / "exec-protocol.md").read_text(encoding="utf-8")
    tree = parse(re.search(r"^For `(.+)` that is$", page, re.MULTILINE)[1])
    rows = re.findall(r"^    (\w+) +(\d+) +(\S+) +(\S+) +−3", page, re.MULTILINE)
    index = {leaf: number for number, leaf in enumerate(leaves(tree))}
    policy = compile_policy(tree, index)
    shown = [
        (list(index)[row[0]].name, *map(str, row[1:]))
        for row in zip(policy.leaf, policy.occurrence, policy.on_success, policy.on_failure, strict=True)
    ]
    assert shown == [(name, *(number.replace("−", "-") for number in numbers)) for name, *numbers in rows]
