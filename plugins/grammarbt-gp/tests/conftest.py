"""A small language of lists, whose trees are scored by what is in them."""

import numpy as np
import pytest

from grammarbt.bt import leaves
from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt.search import Evaluation, SearchContext

VOCABULARY = Vocabulary((Group("g", tuple(map(ActionType, "abc")), (ConditionType("x"),)),))
GRAMMAR = """
%declare ACTION CONDITION
%limit nodes 7
start: "?" "(" part+ ")"
part: ACTION | "→" "(" CONDITION ACTION ")"
"""


@pytest.fixture(scope="session")
def grammar():
    return bind(load_grammar(Source("parts.grammar", GRAMMAR)), VOCABULARY)


@pytest.fixture
def context(grammar):
    def make(seed=0, budget=400, **changes):
        return SearchContext(grammar, VOCABULARY, np.random.default_rng(seed), budget, **changes)

    return make


def score(tree, scenario):
    names = [leaf.name for leaf in leaves(tree)]
    return names.count("a") - 0.1 * len(names) + 0.1 * float(np.random.default_rng(scenario).normal())


@pytest.fixture
def drive():
    """Runs a searcher for some episodes; gives its proposals."""

    def run(searcher, episodes, answer=score, width=4):
        proposals, spent = [], 0
        while spent < episodes and (asked := searcher.ask(width)):
            proposals += asked
            spent += sum(proposal.stop - proposal.start for proposal in asked)
            searcher.tell([_evaluation(proposal, answer) for proposal in asked])
        return proposals

    return run


def _evaluation(proposal, answer):
    returns = tuple(answer(proposal.tree, scenario) for scenario in range(proposal.start, proposal.stop))
    return Evaluation(proposal, returns, (1,) * len(leaves(proposal.tree)))


@pytest.fixture
def names():
    return lambda tree: "".join(leaf.name for leaf in leaves(tree))
