"""Looking returns up, simulating only what is missing, and surviving bad simulators."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grammarbt.domain import Outcome
from grammarbt.run.evaluate import Evaluator


def counting(lamps):
    calls = []

    class Counting(lamps):
        def simulate(self, policy, scenarios):
            calls.append(scenarios.tolist())
            return super().simulate(policy, scenarios)

    return Counting(), calls


def test_known_returns_cost_no_episode_and_are_the_same(lamps, proposal):
    domain, calls = counting(lamps)
    evaluator = Evaluator(domain, seed=3)
    first = evaluator.evaluate([proposal("[light left]", 0, 4)], 100)[0]
    again = evaluator.evaluate([proposal("[light left]", 0, 4)], 0)[0]
    assert again.evaluation.returns == first.evaluation.returns
    assert (first.simulated, again.simulated, evaluator.episodes, len(calls)) == (4, 0, 4, 1)


def test_only_the_missing_scenarios_are_simulated(lamps, proposal):
    domain, calls = counting(lamps)
    evaluator = Evaluator(domain, seed=0)
    evaluator.evaluate([proposal("[light left]", 0, 2)], 100)
    grown = evaluator.evaluate([proposal("[light left]", 0, 5)], 100)[0]
    assert calls == [[0, 1], [2, 3, 4]]
    assert (
        grown.evaluation.returns
        == Evaluator(lamps(), 0).evaluate([proposal("[light left]", 0, 5)], 5)[0].evaluation.returns
    )


def test_trees_that_behave_alike_share_returns(lamps, proposal):
    evaluator = Evaluator(lamps(), seed=0)
    evaluator.evaluate([proposal("→( [light left] [light right] )")], 10)
    assert evaluator.evaluate([proposal("→( [light left] →( [light right] ) )")], 0)[0].simulated == 0


def test_trees_that_behave_alike_share_nothing_where_the_tree_matters(lamps, proposal):
    domain = type("Sized", (lamps,), {"depends_on": "tree"})()
    evaluator = Evaluator(domain, seed=0)
    evaluator.evaluate([proposal("→( [light left] [light right] )")], 10)
    assert evaluator.evaluate([proposal("→( [light left] →( [light right] ) )")], 10)[0].simulated == 1


def test_the_limit_is_never_passed(lamps, proposal):
    evaluator = Evaluator(lamps(), seed=0)
    asked = [proposal("[light left]", 0, 3), proposal("[light left]", 0, 4), proposal("[light right]", 0, 3)]
    trials = evaluator.evaluate(asked, 6)
    assert [trial.simulated for trial in trials] == [3, 1]
    assert evaluator.episodes == 4


def raises(_policy, _scenarios):
    raise ZeroDivisionError("division by zero")


@pytest.mark.parametrize(
    ("simulate", "status", "reason"),
    [
        (raises, "failed", "ZeroDivisionError"),
        (lambda p, s: Outcome(np.full(len(s), np.nan), np.zeros(p.occurrences, int)), "invalid", "finite"),
        (lambda p, s: Outcome(np.zeros(len(s) + 1), np.zeros(p.occurrences, int)), "invalid", "shape"),
        (lambda _, s: Outcome(np.zeros(len(s)), np.zeros(9, int)), "invalid", "ticks"),
        (lambda p, s: Outcome(np.zeros(len(s)), np.full(p.occurrences, np.nan)), "invalid", "ticks"),
        (lambda p, s: Outcome(np.zeros(len(s)), np.full(p.occurrences, None)), "invalid", "type object"),
        (lambda p, s: Outcome(np.zeros(len(s), np.longdouble), np.zeros(p.occurrences, int)), "invalid", "type float"),
        (lambda _p, _s: 7.0, "invalid", "Outcome"),
    ],
)
def test_a_bad_simulator_makes_a_bad_evaluation_and_no_crash(broken, proposal, simulate, status, reason):
    evaluation = Evaluator(broken(simulate), 0).evaluate([proposal("[light left]")], 10)[0].evaluation
    assert (evaluation.status, evaluation.returns) == (status, ())
    assert reason in evaluation.error
    assert evaluation.mean == float("-inf")


def test_a_tree_with_a_foreign_leaf_is_invalid(lamps, proposal):
    evaluation = Evaluator(lamps(), 0).evaluate([proposal("[dance]")], 10)[0].evaluation
    assert evaluation.status == "invalid"
    assert "dance" in evaluation.error


def test_a_simulator_may_answer_in_the_same_arrays_each_time(broken, proposal):
    returns, ticks = np.zeros(1), np.zeros(1, dtype=np.int64)

    def simulate(policy, _):
        returns[:], ticks[:] = policy.tree == proposal("[light left]").tree, 7 + returns[0]
        return Outcome(returns, ticks)

    evaluator = Evaluator(broken(simulate), seed=0)
    trials = evaluator.evaluate([proposal("[light left]"), proposal("[light right]")], 10)
    assert [trial.evaluation.returns for trial in trials] == [(1.0,), (0.0,)]


def test_an_interruption_passes_through(broken, proposal):
    def interrupted(_policy, _scenarios):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        Evaluator(broken(interrupted), 0).evaluate([proposal("[light left]")], 10)


def test_a_trial_says_what_all_returns_of_its_tree_come_to(lamps, proposal):
    evaluator = Evaluator(lamps(), 0)
    late, early, both = (
        evaluator.evaluate([proposal("[light left]", *span)], 10)[0] for span in ((4, 6), (0, 1), (0, 6))
    )
    assert (late.fresh, early.fresh) == (late.evaluation.returns, early.evaluation.returns)
    assert [trial.episodes for trial in (late, early, both)] == [2, 3, 6]
    assert early.mean == pytest.approx(sum(late.fresh + early.fresh) / 3)
    assert both.mean == pytest.approx(both.evaluation.mean)


@pytest.fixture
def asked(proposal):
    """Proposals of few trees on many overlapping ranges."""
    trees = ["[light left]", "[light right]", "(left lit)"]
    return [proposal(trees[at % 7 % 3], at % 4, at % 4 + at % 3 + 1) for at in range(40)]


@given(limit=st.integers(0, 30), batch=st.integers(1, 40))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_batch_gives_what_its_proposals_give_one_by_one(lamps, broken, asked, limit, batch):
    def fails_in_world_2(policy, scenarios):
        return raises(policy, scenarios) if 2 in scenarios else lamps().simulate(policy, scenarios)

    for domain in (lamps(), broken(fails_in_world_2)):
        one_by_one, together = Evaluator(domain, 0), Evaluator(domain, 0)
        expected = []
        for each in asked[:batch]:
            expected += one_by_one.evaluate([each], limit - one_by_one.episodes) or [None]
        first_refused = expected.index(None) if None in expected else len(expected)
        assert together.evaluate(asked[:batch], limit) == expected[:first_refused]
