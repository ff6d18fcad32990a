"""The exported files, loaded in the libraries they are for, tick as we do."""

from __future__ import annotations

from collections import Counter
from importlib import import_module
from itertools import product
from pathlib import Path
from typing import ClassVar

import numpy as np
import py_trees
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from py_trees.parsers.behaviour_tree_xml import parse_behaviour_tree_xml
from py_trees.ports import BehaviourWithPorts

from grammarbt.bt import Action, Not, Parallel, Status, flatten, leaves, parse, tick, walk
from grammarbt.bt.formats import btcpp, py_trees_xml
from grammarbt.bt.formats.slug import tags
from grammarbt.bt.trace import node_statuses

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"
ANSWERS = (Status.SUCCESS, Status.FAILURE, Status.RUNNING)


@pytest.fixture(scope="module")
def benchmarks():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(BENCHMARKS))
        yield import_module


@pytest.fixture(scope="module")
def oracles(benchmarks):
    return benchmarks("oracles")


@pytest.fixture(scope="module")
def engines(benchmarks):
    return benchmarks("engines")


@pytest.fixture(scope="module")
def caught(benchmarks):
    return benchmarks("console").Console


def test_random_trees_tick_alike_in_py_trees_and_behaviortree_cpp(oracles, caught):
    counts = Counter()
    with caught() as console:
        assert oracles.compare(4_000, 1, console, counts) == []
    assert counts["ticks"] == 4_000
    assert counts["trees with parallel nodes"] > 30
    assert min(counts[f"{name}: halted"] for name in ("py_trees", "BehaviorTree.CPP")) > 500


def test_the_comparison_notices_nodes_that_remember(oracles, caught, monkeypatch):
    counts = Counter()
    forgetful = btcpp.dumps
    monkeypatch.setattr(btcpp, "dumps", lambda tree: forgetful(tree).replace("ReactiveSequence>", "Sequence>"))
    monkeypatch.setitem(btcpp.CONTROL, "Sequence", "→")
    with caught() as console:
        assert oracles.compare(1_000, 1, console, counts)
    assert counts["BehaviorTree.CPP: order differs"] > 50
    assert counts["py_trees: order differs"] == 0


@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_trees_with_any_names_load_and_tick_alike(data, any_trees, engines, caught):
    tree = data.draw(any_trees)
    answers = [[data.draw(st.sampled_from(_answers(leaf))) for leaf in leaves(tree)] for _ in range(3)]
    fresh = engines.has_parallel(tree)
    with caught() as console:
        cpp, mine = engines.BehaviorTreeCpp(tree, console), engines.Ours(tree, forgets=fresh)
        assert [cpp.tick(row) for row in answers] == [mine.tick(row) for row in answers]
    py_tree, mine = engines.PyTrees(tree), engines.Ours(tree)
    assert [py_tree.tick(row) for row in answers] == [mine.tick(row) for row in answers]


def _answers(leaf):
    return ANSWERS if isinstance(leaf, Action) else ANSWERS[:2]


@pytest.mark.parametrize("nodes", [20, 200])
def test_ticking_is_far_faster_than_in_py_trees(nodes, benchmarks):
    ticking, rng = benchmarks("ticking"), np.random.default_rng(1)
    trees = [ticking.random_tree(rng, "paper", nodes) for _ in range(3)]

    def is_fast(times):  # other tests run at the same time, so one round may be slow
        return times["py_trees"] / times["flat"] > 120 and times["py_trees"] / times["generated source"] > 300

    assert any(is_fast(ticking.seconds_a_tick(rng, trees)) for _ in range(8))


def test_exported_actions_are_halted_only_when_they_were_running(engines):
    tree = parse("?( →( (c) [a] ) [b] )")
    engine = engines.PyTrees(tree)
    success, failure, running = ANSWERS
    seen = [engine.tick(row) for row in product([success, failure], [running], [running])]
    assert [one.halted for one in seen] == [(), (1,)]
    assert [one.started for one in seen] == [(1,), (2,)]
    finished = [engine.tick([success, success, running]), engine.tick([failure, running, success])]
    assert [one.halted for one in finished] == [(2,), ()]


class Recorder(BehaviourWithPorts, register=False):
    """A leaf for py_trees' XML reader: any attributes, and an answer that the test sets by the leaf's place."""

    INPUT_PORTS: ClassVar = {}
    OUTPUT_PORTS: ClassVar = {}

    def __init__(self, name, behaviour_class_name=None, **arguments):
        super().__init__(name=name, behaviour_class_name=behaviour_class_name)
        self.arguments = arguments

    def update(self):
        return self.answer()


@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_py_trees_reads_its_xml_and_ticks_alike(data, any_trees, tmp_path_factory):
    tree = data.draw(any_trees.filter(lambda tree: not any(isinstance(node, Parallel) for node in walk(tree))))
    path = tmp_path_factory.mktemp("xml") / "tree.xml"
    path.write_text(py_trees_xml.dumps(tree), encoding="utf-8")
    registry = dict.fromkeys(tags(tree, py_trees_xml.RESERVED).values(), Recorder)
    root = parse_behaviour_tree_xml(str(path), node_registry=registry)
    found = [node for node in _pre_order(root) if isinstance(node, Recorder)]
    assert [len(node.arguments) for node in found] == [len(leaf.arguments) for leaf in leaves(tree)]
    for _ in range(3):
        answers = [data.draw(st.sampled_from(_answers(leaf))) for leaf in leaves(tree)]
        assert _tick_theirs(root, found, answers) == _tick_ours(tree, answers)


def _tick_theirs(root, found, answers):
    order = []
    for place, node in enumerate(found):
        node.answer = lambda place=place: order.append(place) or py_trees.common.Status[answers[place].name]
    root.tick_once()
    return Status[root.status.name], order


def _tick_ours(tree, answers):
    order = []
    root = tick(flatten(tree), lambda _, place: order.append(place) or answers[place])
    return root, order


def _pre_order(node):
    yield node
    for child in node.children:
        yield from _pre_order(child)


@settings(max_examples=100, deadline=None)
@given(data=st.data())
def test_the_roots_status_follows_from_the_leaves_that_were_ticked(data, small_trees):
    tree = data.draw(small_trees)
    answers = [data.draw(st.sampled_from(_answers(leaf))) for leaf in leaves(tree)]
    root, order = _tick_ours(tree, answers)
    statuses = node_statuses(tree, {place: answers[place] for place in order})
    assert statuses[0] is root
    assert sum(status is not None for status in statuses) >= len(order)
    swapped = node_statuses(Not(tree), {place: answers[place] for place in order})
    assert swapped[1:] == statuses
