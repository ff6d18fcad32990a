"""The loop keeps the budget and holds searchers to the protocol."""

import pytest

from grammarbt.errors import RunError, SearcherError
from grammarbt.run.evaluate import Evaluator
from grammarbt.run.loop import AskTellLoop
from grammarbt.run.spec import RunSpec

LEFT = "[light left]"


@pytest.fixture
def repeating(fixed, proposal):
    """A searcher that asks for one tree on one scenario after the other."""
    return lambda times: fixed(proposal(LEFT, number, number + 1) for number in range(times))


def loop_of(domain, searcher, **fields):
    batches = []
    spec = RunSpec(**{"selection": 0.0, **fields})
    return AskTellLoop(searcher, Evaluator(domain, spec.seed), spec, batches.append), batches


def test_a_search_ends_at_its_budget(lamps, repeating):
    searcher = repeating(50)
    loop, batches = loop_of(lamps(), searcher, budget=20, batch=3)
    assert loop.run() == "budget"
    assert sum(trial.simulated for batch in batches for trial in batch) == 20
    assert len(searcher.told) == 20


def test_a_proposal_that_does_not_fit_the_budget_ends_the_search_unsimulated(lamps, fixed, proposal):
    loop, batches = loop_of(lamps(), fixed([proposal(LEFT, 0, 6), proposal("[light right]", 0, 6)]), budget=10)
    assert loop.run() == "budget"
    assert [trial.simulated for batch in batches for trial in batch] == [6]


@pytest.mark.parametrize(
    ("fields", "reason", "trials"),
    [
        ({"trials": 4}, "trials", 4),
        ({"target": 5.0}, "target", 1),
        ({"seconds": 0.0}, "seconds", 1),
        ({}, "exhausted", 9),
    ],
)
def test_a_search_stops_for_the_reason_given(lamps, repeating, fields, reason, trials):
    loop, _ = loop_of(lamps(), repeating(9), **fields)
    assert (loop.run(), loop.trials) == (reason, trials)


def test_a_searcher_that_only_repeats_itself_is_stopped(lamps, fixed, proposal):
    loop, _ = loop_of(lamps(), fixed([proposal(LEFT)] * 30_000), batch=100)
    assert loop.run() == "stalled"


def test_the_incumbent_is_the_tree_that_pays_more(lamps, fixed, proposal):
    both = "→( [light left] [light right] )"
    loop, _ = loop_of(lamps(), fixed(proposal(text, 0, 8) for text in (LEFT, both, "(left lit)")))
    loop.run()
    assert loop.incumbent.tree == proposal(both).tree
    assert loop.incumbent.episodes == 8


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        (None, "list of proposals, not NoneType"),
        ([1, 2, 3], r"ask\(1\) returned 3"),
        (["[light left]"], "str among its proposals"),
    ],
)
def test_a_searcher_that_breaks_the_protocol_is_told_how(lamps, fixed, answer, message):
    searcher = fixed([])
    searcher.ask = lambda _: answer
    with pytest.raises(SearcherError, match=message):
        loop_of(lamps(), searcher)[0].run()


@pytest.mark.parametrize(("start", "stop"), [(-1, 1), (1, 1), (0, 2**30 + 1)])
def test_scenarios_out_of_range_are_refused(lamps, fixed, proposal, start, stop):
    with pytest.raises(SearcherError, match="scenarios"):
        loop_of(lamps(), fixed([proposal(LEFT, start, stop)]))[0].run()


def test_a_searcher_that_raises_is_named_by_its_method(lamps, fixed, proposal):
    searcher = fixed([proposal(LEFT)])
    searcher.tell = lambda _: 1 / 0
    with pytest.raises(SearcherError, match="tell raised ZeroDivisionError"):
        loop_of(lamps(), searcher)[0].run()


def test_a_simulator_that_always_fails_ends_the_run_with_its_reason(broken, fixed, proposal):
    def fails(_policy, _scenarios):
        raise OSError("no simulator today")

    loop, batches = loop_of(broken(fails), fixed([proposal(LEFT)] * 1_000))
    with pytest.raises(RunError, match="no simulator today"):
        loop.run()
    assert all(trial.evaluation.status == "failed" for batch in batches for trial in batch)
