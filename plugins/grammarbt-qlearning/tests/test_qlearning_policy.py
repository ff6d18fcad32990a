"""A policy over truth values is learned from returns, and written as a tree that does just that."""

from itertools import product

import numpy as np
import pytest

from grammarbt.bt import Action, Condition, Status, flatten, leaves, parse, ticker
from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.errors import SearcherError
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt.search import Evaluation, Proposal, SearchContext
from grammarbt_qlearning.decisionlist import DecisionLists
from grammarbt_qlearning.parameters import QLearningParameters
from grammarbt_qlearning.search import QLearning

CONDITIONS = tuple(map(Condition, "xyz"))
ACTIONS = tuple(map(Action, "abc"))
VOCABULARY = Vocabulary((Group("g", tuple(map(ActionType, "abc")), tuple(map(ConditionType, "xyz"))),))
LISTS = """
%declare ACTION CONDITION
%limit nodes {nodes}
start: "?" "(" rule+ ACTION ")"
rule: "→" "(" check+ ACTION ")"
check: CONDITION | "!" "(" CONDITION ")"
"""
STATES = list(product((False, True), repeat=3))
RIGHT = {state: "a" if state[0] else "b" if state[1] and not state[2] else "c" for state in STATES}


def acts(tree):
    """The action that the tree ticks first, by what holds."""
    asked, tick, found = leaves(tree), ticker(flatten(tree)), {}
    for state in STATES:
        holds = dict(zip(CONDITIONS, state, strict=True))
        ticked = []

        class Answers:
            def __getitem__(self, at, holds=holds, ticked=ticked):
                if asked[at] in holds:
                    return holds[asked[at]]
                ticked.append(at)
                return Status.RUNNING

        tick(Answers())
        found[state] = ticked[0]
    return found


def evaluated(proposal):
    """The share of states in which the tree does what is right; each comes up once in an episode."""
    asked, first = leaves(proposal.tree), acts(proposal.tree)
    value = sum(asked[at].name == RIGHT[state] for state, at in first.items()) / len(STATES)
    ticks = tuple([*first.values()].count(at) for at in range(len(asked)))
    return Evaluation(proposal, (value,) * (proposal.stop - proposal.start), ticks)


def searcher(start=None, nodes=40):
    grammar = bind(load_grammar(Source("lists.grammar", LISTS.format(nodes=nodes))), VOCABULARY)
    context = SearchContext(grammar, VOCABULARY, np.random.default_rng(0), 600, start=start)
    return QLearning(context, QLearningParameters(table="policy"))


def drive(found, most):
    seen = []
    while len(seen) < most and (asked := found.ask(4)):
        told = list(map(evaluated, asked))
        seen += told
        found.tell(told)
    return seen


@pytest.mark.parametrize("seed", range(20))
def test_a_decision_list_does_what_the_policy_says(seed):
    lists, rng = DecisionLists(CONDITIONS, ACTIONS), np.random.default_rng(seed)
    policy = rng.integers(3, size=8)
    free = rng.random(8) < 0.3
    tree = lists.tree(lists.rules(policy, free))
    asked, first = leaves(tree), acts(tree)
    for truth, wanted, spare in zip(lists.truth.tolist(), policy, free, strict=True):
        assert spare or asked[first[tuple(map(bool, truth))]] == ACTIONS[wanted]


def test_a_policy_is_written_with_far_fewer_leaves_than_its_states_have():
    lists = DecisionLists(CONDITIONS, ACTIONS)
    policy = np.array(["abc".index(RIGHT[tuple(map(bool, truth))]) for truth in lists.truth.tolist()])
    tree = lists.tree(lists.rules(policy, np.zeros(8, dtype=bool)))
    assert len(leaves(tree)) <= 7 < 4 * len(STATES)


def test_the_right_policy_is_found_with_few_trees():
    seen = drive(searcher(), 600)
    assert max(one.mean for one in seen) == 1.0
    assert next(at for at, one in enumerate(seen) if one.mean == 1.0) < 400


def test_the_best_tree_is_the_first_candidate():
    found = searcher()
    drive(found, 600)
    assert evaluated(Proposal(found.candidates(1)[0])).mean == 1.0
    assert found.metrics()["states"] == 8


def test_states_that_never_come_up_cost_no_rules():
    lists = DecisionLists(CONDITIONS, ACTIONS)
    policy = np.array([0, 1, 2, 1, 0, 1, 2, 1])
    never = np.array([False, False, True, False, False, False, True, False])
    assert len(lists.rules(policy, never)) < len(lists.rules(policy, never & False))


def test_a_start_tree_is_tried_first_and_its_policy_is_where_the_search_goes_on():
    start = parse("?( →( (x) [a] ) →( !(y) [c] ) [b] )")
    seen = drive(searcher(start), 8)
    assert seen[0].proposal.tree == start
    assert np.mean([one.mean for one in seen]) > 0.6


def test_policies_stay_within_the_size_that_the_grammar_allows():
    for one in drive(searcher(nodes=9), 60):
        assert len(leaves(one.proposal.tree)) <= 6


def test_a_grammar_without_room_for_a_policy_is_refused():
    pairs = bind(load_grammar(Source("p.grammar", '%declare ACTION\nstart: "→" "(" ACTION ACTION ")"')), VOCABULARY)
    context = SearchContext(pairs, VOCABULARY, np.random.default_rng(0), 100)
    with pytest.raises(SearcherError, match="derives no policies"):
        QLearning(context, QLearningParameters(table="policy"))


def test_too_many_conditions_are_refused():
    names = [f"c{number}" for number in range(9)]
    many = Vocabulary((Group("g", (ActionType("a"),), tuple(map(ConditionType, names))),))
    grammar = bind(load_grammar(Source("l.grammar", LISTS.format(nodes=40))), many)
    with pytest.raises(SearcherError, match="9 conditions"):
        QLearning(SearchContext(grammar, many, np.random.default_rng(0), 100), QLearningParameters(table="policy"))


def test_a_grammar_without_negation_will_do_for_a_single_condition():
    one = Vocabulary((Group("g", tuple(map(ActionType, "ab")), (ConditionType("x"),)),))
    text = '%declare ACTION CONDITION\nstart: "?" "(" "→" "(" CONDITION ACTION ")" ACTION ")"'
    grammar = bind(load_grammar(Source("one.grammar", text)), one)
    found = QLearning(SearchContext(grammar, one, np.random.default_rng(0), 100), QLearningParameters(table="policy"))
    seen = {str(proposal.tree) for _ in range(20) for proposal in told(found)}
    assert len(seen) == 4


def told(found):
    asked = found.ask(4)
    found.tell([Evaluation(one, (0.0,) * (one.stop - one.start)) for one in asked])
    return asked
