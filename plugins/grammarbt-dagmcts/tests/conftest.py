"""A small language of lists of sub-trees, and a cheap score for its trees."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from grammarbt.bt import children, leaves, parse
from grammarbt.bt.canonical import canonical_key
from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt.search import Evaluation, SearchContext
from grammarbt_dagmcts.parameters import DagMctsParameters
from grammarbt_dagmcts.search import DagMcts

GRAMMAR = """
%declare ACTION CONDITION
%forall g in GROUP
%unique ACTION CONDITION in subtree
%unique g in start
start: "?" "(" each each+ ")"
each: subtree{g}
subtree{g}: "→" "(" ACTION{g} ")" | "→" "(" left{g} ACTION{g} ")" | "→" "(" ACTION{g} right{g} ")"
left{g}: left{g} check{g} | check{g}
right{g}: ACTION{g} right{g} | ACTION{g}
check{g}: CONDITION{g} | "!" "(" CONDITION{g} ")"
"""

GOAL = parse("?( →( (hungry) !(full) [eat] ) →( (tired) [sleep] ) →( [walk] ) )")


@pytest.fixture(scope="session")
def vocabulary():
    groups = (
        Group("food", (ActionType("eat"), ActionType("cook")), (ConditionType("hungry"), ConditionType("full"))),
        Group("rest", (ActionType("sleep"),), (ConditionType("tired"),)),
        Group("move", (ActionType("walk"),)),
    )
    return Vocabulary(groups)


@pytest.fixture(scope="session")
def grammar(vocabulary):
    return bind(load_grammar(Source("lists.grammar", GRAMMAR)), vocabulary)


@pytest.fixture(scope="session")
def goal():
    return GOAL


@pytest.fixture
def context(grammar, vocabulary):
    def make(seed=0, **changes):
        settings = {"grammar": grammar, "vocabulary": vocabulary, "rng": np.random.default_rng(seed), "budget": 1_000}
        return SearchContext(**{**settings, **changes})

    return make


key = cache(canonical_key)


def score(tree, scenario):
    """10 per sub-tree that behaves like one of the goal, more when it stands in its place, and the scenario's noise."""
    wanted, found = [key(part) for part in children(GOAL)], [key(part) for part in children(tree)]
    value = sum(10.0 for part in wanted if part in found)
    value += sum(2.0 for one, other in zip(wanted, found, strict=False) if one == other)
    return value - 0.1 * len(found) + float(np.random.default_rng(scenario).normal())


def evaluate(proposal):
    returns = tuple(score(proposal.tree, scenario) for scenario in range(proposal.start, proposal.stop))
    return Evaluation(proposal, returns, (len(returns),) * len(leaves(proposal.tree)))


@pytest.fixture
def answer():
    return evaluate


@pytest.fixture
def search(context):
    """Runs a search for some episodes; gives the searcher and everything that it proposed."""

    def run(episodes, *, seed=0, batch=1, answer=evaluate, **parameters):
        searcher = DagMcts(context(seed), DagMctsParameters(**parameters))
        proposals, spent = [], 0
        while spent < episodes and (asked := searcher.ask(batch)):
            proposals += asked
            spent += sum(proposal.stop - proposal.start for proposal in asked)
            searcher.tell([answer(proposal) for proposal in asked])
        return searcher, proposals

    return run
