import numpy as np
import pytest

from grammarbt.bt import children, parse
from grammarbt.bt.canonical import behave_alike, canonical_key
from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.errors import GrammarBTError
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt.search import BlockDag, Evaluation, SearchContext, Stream, behaviour_of
from grammarbt_compose.parameters import ComposeParameters
from grammarbt_compose.search import Compose

LISTS = """
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
NESTED = """
%declare ACTION CONDITION
%limit nodes 12
start: "?" "(" part+ ")"
part: ACTION | "→" "(" CONDITION+ part ")"
"""
VOCABULARY = Vocabulary(
    (
        Group("food", (ActionType("eat"), ActionType("cook")), (ConditionType("hungry"), ConditionType("full"))),
        Group("rest", (ActionType("sleep"),), (ConditionType("tired"),)),
        Group("move", (ActionType("walk"),)),
    )
)
GOAL = parse("?( →( (hungry) !(full) [eat] ) →( (tired) [sleep] ) →( [walk] ) )")
NESTED_GOAL = parse("?( →( (hungry) →( (full) [cook] ) ) →( (tired) [sleep] ) [walk] )")


def context(text=LISTS, **changes):
    grammar = bind(load_grammar(Source("lists.grammar", text)), VOCABULARY)
    settings = {"grammar": grammar, "vocabulary": VOCABULARY, "rng": np.random.default_rng(0), "budget": 1_500}
    return SearchContext(**{**settings, **changes})


def score(goal, tree, noise):
    wanted, found = ([canonical_key(part) for part in children(each)] for each in (goal, tree))
    value = sum(10.0 for part in wanted if part in found)
    value += sum(2.0 for one, other in zip(wanted, found, strict=False) if one == other)
    return value - 0.1 * len(found) + noise


def run(given, goal, episodes=1_500, batch=1, noise=1.0, **parameters):
    searcher = Compose(given, ComposeParameters(**parameters))
    proposals, spent = [], 0
    while spent < episodes and (asked := searcher.ask(batch)):
        proposals += asked
        spent += sum(proposal.stop - proposal.start for proposal in asked)
        searcher.tell([answer(proposal, goal, noise) for proposal in asked])
    return searcher, proposals


def answer(proposal, goal, noise):
    numbers = range(proposal.start, proposal.stop)
    returns = [score(goal, proposal.tree, noise * float(np.random.default_rng(n).normal())) for n in numbers]
    return Evaluation(proposal, tuple(returns))


@pytest.mark.parametrize("batch", [1, 6])
def test_it_composes_the_goal_from_noisy_returns(batch):
    searcher, _ = run(context(), GOAL, batch=batch)
    assert behave_alike(searcher.candidates(1)[0], GOAL)


def test_it_finds_the_goal_where_trees_are_no_lists_of_groups():
    searcher, _ = run(context(NESTED), NESTED_GOAL, episodes=4_000, noise=0.0, round_episodes=1_000)
    assert behave_alike(searcher.candidates(1)[0], NESTED_GOAL)


@pytest.mark.parametrize("text", [LISTS, NESTED])
def test_same_seed_gives_the_same_proposals(text):
    assert run(context(text), GOAL, 300)[1] == run(context(text), GOAL, 300)[1]


@pytest.mark.parametrize("text", [LISTS, NESTED])
def test_every_derivation_gives_the_proposed_tree(text):
    given = context(text)
    for proposal in run(given, GOAL, 300)[1]:
        assert given.grammar.tree(given.grammar.derive(proposal.derivation)) == proposal.tree


@pytest.mark.parametrize(("text", "goal"), [(LISTS, GOAL), (NESTED, NESTED_GOAL)])
def test_it_begins_from_the_start_tree(text, goal):
    searcher, proposals = run(context(text, start=goal), goal, 200)
    assert goal in {proposal.tree for proposal in proposals[:14]}
    assert behave_alike(searcher.candidates(1)[0], goal)


@pytest.mark.parametrize("text", [LISTS, NESTED])
def test_a_start_tree_outside_the_language_is_one_line(text):
    with pytest.raises(GrammarBTError):
        Compose(context(text, start=parse("→( [walk] [walk] )")), ComposeParameters())


def test_a_stream_gives_every_behaviour_once_before_any_again():
    given = context()
    dag = BlockDag(given.grammar, given.grammar.blocks[0], behaviour_of(given), 1_000)
    stream = Stream(dag)
    first = [stream.draw(given.rng, (), None)[1] for _ in range(dag.words - 4)]
    assert len(set(first)) == len(first)
    assert len({stream.draw(given.rng, (), None)[1] for _ in range(3 * dag.words)} | set(first)) == dag.words
