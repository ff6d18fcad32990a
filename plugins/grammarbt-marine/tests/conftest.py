"""The default domain, shared by all tests, and what it takes to simulate a tree in notation."""

import numpy as np
import pytest

from grammarbt.bt import compile_policy, parse
from grammarbt_marine.domain import Marine


@pytest.fixture(scope="session")
def marine():
    return Marine()


@pytest.fixture(scope="session")
def returns(marine):
    """The returns of a tree in notation on the first so many scenarios."""

    def simulate(tree, episodes):
        policy = compile_policy(parse(tree), marine.vocabulary.index)
        return marine.simulate(policy, np.arange(episodes)).returns

    return simulate
