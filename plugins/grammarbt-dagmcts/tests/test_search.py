from itertools import count

import pytest

from grammarbt.bt import behave_alike, children, leaves, parse
from grammarbt.errors import SearcherError
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt.search import Evaluation
from grammarbt_dagmcts.dag import ROOT
from grammarbt_dagmcts.parameters import DagMctsParameters
from grammarbt_dagmcts.search import DagMcts

PUBLISHED = ("paper", "mcdags")
PRESETS = ("default", *PUBLISHED)


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("batch", [1, 5])
def test_same_seed_gives_the_same_proposals(search, preset, batch):
    _, first = search(300, seed=3, batch=batch, preset=preset)
    _, second = search(300, seed=3, batch=batch, preset=preset)
    assert first == second


@pytest.mark.parametrize("preset", PRESETS)
def test_another_seed_gives_other_proposals(search, preset):
    assert search(50, seed=1, preset=preset)[1] != search(50, seed=2, preset=preset)[1]


@pytest.mark.parametrize("preset", PRESETS)
def test_every_derivation_gives_the_proposed_tree(search, grammar, preset):
    _, proposals = search(400, preset=preset, restart_every=100)
    for proposal in proposals:
        assert grammar.tree(grammar.derive(proposal.derivation)) == proposal.tree


@pytest.mark.parametrize("batch", [1, 6])
def test_default_finds_the_goal(search, goal, batch):
    searcher, _ = search(1_500, batch=batch)
    assert behave_alike(searcher.candidates(1)[0], goal)


@pytest.mark.parametrize("preset", PUBLISHED)
def test_the_published_methods_find_more_than_they_tried_first(search, goal, preset):
    searcher, proposals = search(1_500, preset=preset)
    assert parts_of(goal, searcher.candidates(1)[0]) > parts_of(goal, proposals[0].tree)


def parts_of(goal, tree):
    return sum(any(behave_alike(part, other) for other in children(tree)) for part in children(goal))


@pytest.mark.parametrize("preset", PRESETS)
def test_failed_evaluations_do_not_stop_the_search(search, preset):
    from_good = count()

    def answer(proposal):
        if next(from_good) % 3 == 0:
            return Evaluation(proposal, (), status="timeout", error="too slow")
        returns = tuple(float(len(leaves(proposal.tree))) for _ in range(proposal.start, proposal.stop))
        return Evaluation(proposal, returns)

    searcher, proposals = search(300, preset=preset, answer=answer)
    assert len(proposals) > 50
    assert searcher.candidates(3)


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("bandit", ["ucb1-tuned", "ucb1-normal2", "ucb1-uniform", "threshold-ascent"])
def test_every_bandit_rule_searches(search, preset, bandit):
    searcher, _ = search(300, preset=preset, bandit=bandit)
    assert searcher.metrics()["nodes"] > 1
    assert searcher.candidates(1)


def test_batches_are_no_larger_than_asked(context):
    searcher = DagMcts(context(), DagMctsParameters())
    assert 1 <= len(searcher.ask(4)) <= 4


def test_telling_something_else_than_asked_is_an_error(context):
    searcher = DagMcts(context(), DagMctsParameters())
    searcher.ask(2)
    with pytest.raises(SearcherError, match="told 0 evaluations of 2"):
        searcher.tell([])


def test_asking_twice_is_an_error(context):
    searcher = DagMcts(context(), DagMctsParameters())
    searcher.ask(1)
    with pytest.raises(SearcherError, match="asked again"):
        searcher.ask(1)


def test_trees_that_are_no_lists_are_found_too(context, vocabulary):
    text = '%declare ACTION CONDITION\nstart: ACTION | "→" "(" CONDITION start ")"\n%limit nodes 7\n'
    plain = bind(load_grammar(Source("plain.grammar", text)), vocabulary)
    searcher = DagMcts(context(grammar=plain), DagMctsParameters(round_episodes=300))
    wanted = parse("→( (full) →( (tired) [cook] ) )")
    for _ in range(1_000):
        (asked,) = searcher.ask(1)
        value = sum(one == other for one, other in zip(leaves(wanted), leaves(asked.tree), strict=False))
        searcher.tell([Evaluation(asked, (value - 0.1 * len(leaves(asked.tree)),) * (asked.stop - asked.start))])
    assert searcher.candidates(1)[0] == wanted


@pytest.mark.parametrize("preset", PUBLISHED)
def test_the_published_methods_begin_from_the_start_tree(context, goal, grammar, preset):
    searcher = DagMcts(context(start=goal), DagMctsParameters(preset=preset))
    (first,) = searcher.ask(1)
    assert first.tree == goal
    searcher.tell([Evaluation(first, (5.0,))])
    dag = searcher.strategy.search.dag
    (word,) = (node for node in range(len(dag)) if dag.words[node])
    assert grammar.tree(dag.form(word)) == goal
    assert dag.closed[word]
    assert dag.rewards.visits[word] == dag.rewards.visits[ROOT] == 1


@pytest.mark.parametrize("preset", PUBLISHED)
def test_a_finished_language_leaves_nothing_to_ask(context, vocabulary, preset):
    text = '%declare ACTION CONDITION\nstart: "?" "(" ACTION ACTION ")"\n'
    pairs = bind(load_grammar(Source("pairs.grammar", text)), vocabulary)
    searcher = DagMcts(context(grammar=pairs), DagMctsParameters(preset=preset, round_length=1_000))
    trees = []
    while asked := searcher.ask(3):
        trees += [proposal.tree for proposal in asked]
        searcher.tell([Evaluation(proposal, (1.0,)) for proposal in asked])
    assert len(set(trees)) == 16


def test_default_begins_from_a_given_tree(context, goal):
    searcher = DagMcts(context(start=goal), DagMctsParameters())
    assert searcher.ask(1)[0].tree == goal


def test_a_given_tree_outside_the_language_is_an_error(context):
    with pytest.raises(SearcherError, match="not in the language"):
        DagMcts(context(start=parse("?( [walk] [eat] )")), DagMctsParameters())


@pytest.mark.parametrize("preset", PRESETS)
def test_there_are_candidates_after_one_episode(search, preset):
    searcher, proposals = search(1, preset=preset)
    assert searcher.candidates(1) == (proposals[0].tree,)
