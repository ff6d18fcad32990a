"""What it takes to simulate a tree in notation."""

import numpy as np
import pytest

from grammarbt.bt import compile_policy, parse
from grammarbt_pickplace.domain import PickPlace
from grammarbt_pickplace.parameters import PickPlaceParameters


@pytest.fixture(scope="session")
def returns():
    """The returns of a tree in notation in a task, on the first so many scenarios."""

    def simulate(task, tree, episodes=500, *, stochastic=False):
        domain = PickPlace(PickPlaceParameters(task, stochastic))
        return domain.simulate(compile_policy(parse(tree), domain.vocabulary.index), np.arange(episodes)).returns

    return simulate
