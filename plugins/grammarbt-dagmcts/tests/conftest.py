"""A small language of lists of sub-trees, and searches in it."""

from __future__ import annotations

import pytest
from attrs import evolve

from grammarbt.testing import errands
from grammarbt_dagmcts.parameters import DagMctsParameters
from grammarbt_dagmcts.search import DagMcts

PUZZLE = errands()


@pytest.fixture(scope="session")
def vocabulary():
    return PUZZLE.vocabulary


@pytest.fixture(scope="session")
def grammar():
    return PUZZLE.grammar


@pytest.fixture(scope="session")
def goal():
    return PUZZLE.solution


@pytest.fixture
def context():
    return lambda seed=0, **changes: evolve(PUZZLE.context(seed), **changes)


@pytest.fixture
def answer():
    return PUZZLE.evaluate


@pytest.fixture
def search(context):
    """Runs a search for some episodes; gives the searcher and everything that it proposed."""

    def run(episodes, *, seed=0, batch=1, answer=None, **parameters):
        searcher = DagMcts(context(seed), DagMctsParameters(**parameters))
        return searcher, PUZZLE.drive(searcher, episodes, batch, answer)

    return run
