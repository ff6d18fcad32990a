"""The log is the one that BehaviorTree.CPP writes."""

import itertools
import re
import struct
import time
from collections import defaultdict

import behaviortreepy
import numpy as np
import pytest

from grammarbt.bt import Action, Status, leaves, parse
from grammarbt.bt.formats import btcpp
from grammarbt.domain import Episode, Frame
from grammarbt.report.btlog import dumps

TREES = (
    "?( →( (a) [b] ) [c] )",
    "→( !(a) ?( (b) [c] ) [d] )",
    "?( !(→( (a) (b) )) →( ?( [c] (a) ) [d] ) )",
    "[b]",
)


def read(data):
    """The XML and the changes of a log: time, number, status."""
    assert data[:19] == b"BTCPP4-FileLogger2\x01"
    (size,) = struct.unpack_from("<i", data, 19)
    changes = data[23 + size + 8 :]
    assert len(changes) % 9 == 0
    parts = [changes[at : at + 9] for at in range(0, len(changes), 9)]
    return data[23 : 23 + size].decode(), [
        (int.from_bytes(p[:6], "little"), *struct.unpack("<HB", p[6:])) for p in parts
    ]


def answers_for(tree, rng):
    """What each leaf would answer in a tick."""
    return [rng.choice([1, 2, 3]) if isinstance(leaf, Action) else rng.choice([2, 3]) for leaf in leaves(tree)]


def library_tree(tree, answer):
    """The tree in the library, with one function behind every leaf."""
    factory = behaviortreepy.BehaviorTreeFactory()
    xml = btcpp.dumps(tree)
    for tag in re.findall(r'<Action ID="(.*?)"', xml):
        factory.register_simple_stateful_action(tag, answer, answer, lambda _: None)
    for tag in re.findall(r'<Condition ID="(.*?)"', xml):
        factory.register_simple_condition(tag, answer)
    factory.register_behavior_tree_from_text(xml)
    return factory.create_tree("MainTree")


def library_log(tree, ticks, path):
    """What the library's own logger writes, and the order of its ticked leaves with their answers, tick by tick."""
    asked, now, occurrences = [], {}, {}
    statuses = {1: behaviortreepy.NodeStatus.RUNNING, 2: behaviortreepy.NodeStatus.SUCCESS}

    def answer(node):
        occurrence = occurrences[node.uid()]
        asked[-1].append((occurrence, now["answers"][occurrence]))
        return statuses.get(now["answers"][occurrence], behaviortreepy.NodeStatus.FAILURE)

    made = library_tree(tree, answer)
    logger = behaviortreepy.FileLogger(made, str(path))
    numbered = re.findall(r'<(\w+) name="\w+" _uid="(\d+)"', path.read_bytes()[23:].decode(errors="replace"))
    uids = [int(uid) for tag, uid in numbered if re.fullmatch("[a-d]", tag)]
    occurrences.update((uid, at) for at, uid in enumerate(uids))
    for answers in ticks:
        now["answers"] = answers
        asked.append([])
        made.tick_exactly_once()
    time.sleep(0.2)  # its writing thread
    logger.flush()
    return path.read_bytes(), asked


def settled(changes):
    """The changes of each node, in order."""
    found = defaultdict(list)
    for _, number, status in changes:
        found[number].append(status)
    return found


@pytest.mark.parametrize("text", TREES)
def test_every_node_changes_as_in_the_librarys_own_log(text, tmp_path):
    tree, rng = parse(text), np.random.default_rng(4)
    ticks = [answers_for(tree, rng) for _ in range(25)]
    theirs, asked = library_log(tree, ticks, tmp_path / "log.btlog")
    kinds = {1: Status.RUNNING, 2: Status.SUCCESS, 3: Status.FAILURE}
    frames = tuple(Frame(tuple((at, kinds[code]) for at, code in tick), 0.0) for tick in asked)
    _, ours = read(dumps(tree, Episode(frames)))
    assert settled(ours) == settled(read(theirs)[1])


def test_the_library_reads_the_xml_of_the_log_and_numbers_its_nodes_alike(tmp_path):
    tree = parse("?( →( (a) ‖1( [b] [b] ) ) !(c) )")
    xml, _ = read(dumps(tree, Episode((Frame(((0, Status.FAILURE), (3, Status.SUCCESS)), 0.0),))))
    theirs, _ = library_log(tree, [], tmp_path / "log.btlog")
    tags = r'<(\w+)[^>]*? _uid="(\d+)"'
    assert re.findall(tags, xml) == re.findall(tags, read(theirs)[0])


def test_time_never_runs_backwards():
    tree = parse("?( →( (a) [b] ) [c] )")
    frames = (
        Frame(((0, Status.FAILURE), (2, Status.RUNNING)), 0.0),
        Frame(((0, Status.SUCCESS), (1, Status.SUCCESS)), 0.0),
    )
    _, changes = read(dumps(tree, Episode(frames * 3)))
    times = [at for at, _, _ in changes]
    assert all(before <= after for before, after in itertools.pairwise(times))
