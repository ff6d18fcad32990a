"""Which scenario is asked for next, and what is then known of a derivation."""

import numpy as np
import pytest

from grammarbt.search import Evaluation, Scorer, States


@pytest.fixture
def scorer(grammars):
    return Scorer(States(grammars["lists"]))


@pytest.fixture
def derivations(grammars):
    rng = np.random.default_rng(0)
    return list(dict.fromkeys(grammars["lists"].sample(rng) for _ in range(60)))[:30]


def simulated(scorer, derivations, answer, scenario=None):
    """Scores derivations by an answer per (tree, scenario); gives the scores and what was proposed."""
    batches, asked = scorer.score(derivations, scenario), []
    try:
        proposals = next(batches)
        while True:
            asked += proposals
            proposals = batches.send([evaluation(proposal, answer) for proposal in proposals])
    except StopIteration as stop:
        return stop.value, asked


def evaluation(proposal, answer):
    returns = tuple(answer(proposal.tree, scenario) for scenario in range(proposal.start, proposal.stop))
    status = "failed" if None in returns else "ok"
    return Evaluation(proposal, () if status == "failed" else returns, (), status)


def plain(tree, scenario):
    return float(sum(map(ord, str(tree))))


def noisy(tree, scenario):
    return len(str(tree)) + float(np.random.default_rng(scenario).normal())


def test_where_scenarios_are_alike_nothing_is_simulated_twice(scorer, derivations):
    simulated(scorer, derivations, plain)
    assert scorer.alike
    scores, asked = simulated(scorer, derivations, plain)
    assert asked == []
    assert [score.mean for score in scores] == [plain(scorer.states.tree(one), 0) for one in derivations]
    assert all(map(scorer.is_settled, derivations))


def test_where_they_are_not_each_batch_meets_a_fresh_one(scorer, derivations):
    simulated(scorer, derivations, noisy)
    assert scorer.alike is False
    asked = [simulated(scorer, derivations, noisy)[1] for _ in range(3)]
    assert [{(one.start, one.stop) for one in batch} for batch in asked] == [{(n, n + 1)} for n in (2, 3, 4)]
    assert not any(map(scorer.is_settled, derivations))


def test_constant_returns_prove_nothing(scorer, derivations):
    simulated(scorer, derivations, lambda tree, scenario: 1.0)
    assert scorer.alike is None
    for _ in range(3):
        simulated(scorer, derivations, lambda tree, scenario: 1.0)
    assert scorer.alike is False


def test_a_given_scenario_is_the_one_asked_for(scorer, derivations):
    _, asked = simulated(scorer, derivations[:3], noisy, scenario=70)
    assert {(one.start, one.stop) for one in asked} == {(70, 71)}


def test_what_failed_is_not_simulated_again_and_never_believed_in(scorer, derivations):
    bad = scorer.states.tree(derivations[0])
    simulated(scorer, derivations, lambda tree, scenario: None if tree == bad else noisy(tree, scenario))
    _, asked = simulated(scorer, derivations, noisy)
    assert bad not in {one.tree for one in asked}
    assert bad not in scorer.best(100)
    assert scorer.reward(scorer.scores[derivations[0]]) == scorer.low


def test_a_mean_of_many_returns_is_believed_before_an_equal_one_of_few(scorer, derivations):
    one, other = derivations[:2]
    for _ in range(9):
        simulated(scorer, [one], lambda tree, scenario: float(scenario % 2))
    simulated(scorer, [other], lambda tree, scenario: scorer.scores[one].mean)
    assert scorer.best(2)[0] == scorer.states.tree(one)
