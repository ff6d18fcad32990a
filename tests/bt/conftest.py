"""What the tests of trees share: random trees, and an interpreter too plain to be wrong."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from hypothesis import strategies as st

from grammarbt.bt import Action, Condition, Fallback, Not, Parallel, Sequence, Status
from grammarbt.testing import trees_over

FORBIDDEN = "[](){}\u2028\u2029\ufffe\uffff"
AWKWARD = [
    "go to comms",
    "?",
    "->",
    "→ x",
    "!b",
    "‖2",
    "||2",
    "=1",
    "a;;b",
    "|",
    "<!>",
    "f",
    "x?",
    "x!",
    "not x",
    "a.b/c:d",
]
AWKWARD += [
    "&amp;",
    "<b>",
    "'\"\\",
    "%s",
    "$x",
    "#",
    "--",
    "]]>"[2:],
    "Sequence",
    "AlwaysSuccess",
    "root",
    "été",
    "搬运",
    "a\u00a0b",
]


def _names(*, more_forbidden=""):
    characters = st.characters(exclude_categories=("Cs", "Cc"), exclude_characters=FORBIDDEN + more_forbidden)
    free = st.text(characters, min_size=1, max_size=8).map(str.strip).filter(bool)
    awkward = [name for name in AWKWARD if not set(name) & set(more_forbidden)]
    return st.sampled_from(awkward) | free


def _leaves():
    key = _names(more_forbidden="=,")
    arguments = st.dictionaries(key, key, max_size=2).map(lambda found: tuple(found.items()))
    return st.builds(Action, _names(), arguments) | st.builds(Condition, _names(), arguments)


@pytest.fixture(scope="session")
def any_trees():
    """Trees with all the names and arguments there may be."""
    return trees_over(_leaves())


@pytest.fixture(scope="session")
def small_trees():
    """Trees over two actions and two conditions, so that leaves repeat."""
    return trees_over(st.sampled_from([Action("a"), Action("b"), Condition("c"), Condition("d")]))


@pytest.fixture(scope="session")
def interpret():
    """Tick a tree by walking it: `interpret(tree, answer)` asks `answer(leaf)` and returns the root's status."""
    return _interpret


def _interpret(node, answer):
    match node:
        case Not(child):
            status = _interpret(child, answer)
            return {Status.SUCCESS: Status.FAILURE, Status.FAILURE: Status.SUCCESS}.get(status, status)
        case Fallback(parts):
            return next(
                (s for s in (_interpret(part, answer) for part in parts) if s != Status.FAILURE), Status.FAILURE
            )
        case Sequence(parts):
            return next(
                (s for s in (_interpret(part, answer) for part in parts) if s != Status.SUCCESS), Status.SUCCESS
            )
        case Parallel(parts, successes):
            return _interpret_parallel(parts, successes, answer)
    return answer(node)


def _interpret_parallel(parts, successes, answer):
    seen = []
    for part in parts:
        seen.append(_interpret(part, answer))
        if seen.count(Status.SUCCESS) >= successes:
            return Status.SUCCESS
        if seen.count(Status.FAILURE) > len(parts) - successes:
            return Status.FAILURE
    return Status.RUNNING


@pytest.fixture
def printed():
    """What a program prints in processes that hash differently."""

    def run(program):
        return {
            subprocess.run(
                [sys.executable, "-c", program],
                env={**os.environ, "PYTHONHASHSEED": seed},
                capture_output=True,
                text=True,
                check=True,
            ).stdout.strip()
            for seed in ("1", "2")
        }

    return run
