"""Where the tests find the programs to run."""

import sys
import time
from pathlib import Path

import numpy as np
import pytest

from grammarbt.bt import compile_policy, parse
from grammarbt_exec.domain import make_exec
from grammarbt_exec.parameters import ExecParameters

HERE = Path(__file__).parent
STRAY = HERE / "stray.py"

sys.path.append(str(HERE))  # what the tests share


@pytest.fixture
def stray():
    """The command that starts a program with a fault; the program works well before and after it."""
    return lambda fault="", *more: " ".join([sys.executable, str(STRAY), fault or "none", *map(str, more)])


@pytest.fixture
def make(stray):
    """Makes domains, and ends their programs at once in the end."""
    made = []

    def make(fault="", *more, **limits):
        made.append(make_exec(ExecParameters(stray(fault, *more), **limits)))
        return made[-1]

    yield make
    for domain in made:
        domain.close()


@pytest.fixture
def ask():
    """The returns of a tree in scenarios 0, 1, …"""

    def ask(domain, tree="?( →( (near) [go(to=home)] ) [stay] )", scenarios=3):
        policy = compile_policy(parse(tree), domain.vocabulary.index)
        return domain.simulate(policy, np.arange(scenarios)).returns.tolist()

    return ask


@pytest.fixture
def holds_within():
    """Whether something comes true in so many seconds."""

    def holds(seconds, condition):
        deadline = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > deadline:
                return False
            time.sleep(0.02)
        return True

    return holds


@pytest.fixture
def gone():
    """Whether none of the processes runs any more."""

    def gone(processes):
        states = [Path(f"/proc/{process}/stat") for process in processes]
        return all(not state.exists() or state.read_text().rsplit(")", 1)[1].split()[0] == "Z" for state in states)

    return gone
