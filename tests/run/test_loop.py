"""The loop keeps the budget and holds searchers to the protocol."""

import pytest

from grammarbt.errors import RunError, SearcherError
from grammarbt.run.evaluate import Evaluator
from grammarbt.run.loop import MAX_FAILURES, AskTellLoop
from grammarbt.run.spec import RunSpec
from grammarbt.run.stopping import Tally

LEFT = "[light left]"


@pytest.fixture
def repeating(fixed, proposal):
    """A searcher that asks for one tree on one scenario after the other."""
    return lambda times: fixed(proposal(LEFT, number, number + 1) for number in range(times))


class Listener:
    """Follows a search that takes a second per batch."""

    def __init__(self):
        self.batches, self.seconds = [], 0.0

    def evaluated(self, trials):
        self.batches.append(trials)

    def learned(self):
        self.seconds += 1


def search(domain, searcher, **fields):
    """Search to the end: why it stopped, the counts, and the batches."""
    spec, tally, listener = RunSpec(**{"selection": 0.0, **fields}), Tally(), Listener()
    reason = AskTellLoop(searcher, Evaluator(domain, spec.seed), spec, tally, listener).run()
    return reason, tally, listener.batches


def test_a_search_ends_at_its_budget(lamps, repeating):
    searcher = repeating(50)
    reason, tally, batches = search(lamps(), searcher, budget=20, batch=3)
    assert (reason, tally.episodes) == ("budget", 20)
    assert sum(trial.simulated for batch in batches for trial in batch) == 20
    assert len(searcher.told) == 20


def test_a_proposal_that_does_not_fit_the_budget_ends_the_search_unsimulated(lamps, fixed, proposal):
    reason, _, batches = search(lamps(), fixed([proposal(LEFT, 0, 6), proposal("[light right]", 0, 6)]), budget=10)
    assert reason == "budget"
    assert [trial.simulated for batch in batches for trial in batch] == [6]


@pytest.mark.parametrize(
    ("fields", "reason", "trials"),
    [
        ({"trials": 4}, "trials", 4),
        ({"target": 5.0}, "target", 1),
        ({"seconds": 0.0}, "seconds", 1),
        ({"seconds": 3.0}, "seconds", 3),
        ({"stagnation": 5}, "stagnation", 6),
        ({"stagnation": 5, "seconds": 4, "trials": 7}, "seconds", 4),
        ({"stagnation": 5, "seconds": 8, "trials": 7}, "stagnation", 6),
        ({"stagnation": 50, "seconds": 8, "trials": 7, "target": 99}, "trials", 7),
        ({}, "exhausted", 9),
    ],
)
def test_a_search_stops_for_the_first_reason_that_holds(lamps, repeating, fields, reason, trials):
    stopped, tally, _ = search(lamps(), repeating(9), **fields)
    assert (stopped, tally.trials) == (reason, trials)


def test_a_better_tree_puts_stagnation_off(lamps, fixed, proposal):
    both = "→( [light left] [light right] )"
    asked = [proposal(text, 0, 8) for text in ("(left lit)", LEFT, "(right lit)", both, "!(left lit)", "!(right lit)")]
    reason, tally, _ = search(lamps(), fixed(asked), stagnation=17)
    assert (reason, tally.episodes, tally.improved) == ("exhausted", 48, 32)
    reason, tally, _ = search(lamps(), fixed(asked), stagnation=8)
    assert (reason, tally.episodes, tally.improved) == ("stagnation", 24, 16)


def test_a_searcher_that_only_repeats_itself_is_stopped(lamps, fixed, proposal):
    assert search(lamps(), fixed([proposal(LEFT)] * 30_000), batch=100)[0] == "stalled"


def test_the_incumbent_is_the_tree_that_pays_more(lamps, fixed, proposal):
    both = "→( [light left] [light right] )"
    _, tally, _ = search(lamps(), fixed(proposal(text, 0, 8) for text in (LEFT, both, "(left lit)")))
    assert tally.incumbent.tree == proposal(both).tree
    assert tally.incumbent.episodes == 8


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
        search(lamps(), searcher)


@pytest.mark.parametrize(("start", "stop"), [(-1, 1), (1, 1), (0, 2**30 + 1)])
def test_scenarios_out_of_range_are_refused(lamps, fixed, proposal, start, stop):
    with pytest.raises(SearcherError, match="scenarios"):
        search(lamps(), fixed([proposal(LEFT, start, stop)]))


def test_a_searcher_that_raises_is_named_by_its_method(lamps, fixed, proposal):
    searcher = fixed([proposal(LEFT)])
    searcher.tell = lambda _: 1 / 0
    with pytest.raises(SearcherError, match="tell raised ZeroDivisionError"):
        search(lamps(), searcher)


def test_a_simulator_that_always_fails_ends_the_run_with_its_first_reason(broken, fixed, proposal):
    days = iter(range(1_000))

    def fails(_policy, _scenarios):
        raise OSError(f"no simulator on day {next(days)}")

    searcher = fixed([proposal(LEFT)] * 1_000)
    with pytest.raises(RunError, match="in a row, the first with: OSError: no simulator on day 0"):
        search(broken(fails), searcher)
    assert [evaluation.status for evaluation in searcher.told] == ["failed"] * MAX_FAILURES


def test_failures_that_are_not_in_a_row_end_no_run_and_are_counted(lamps, broken, fixed, proposal):
    def fails_mostly(policy, scenarios):
        if scenarios[0] % MAX_FAILURES:
            raise OSError("not today")
        return lamps().simulate(policy, scenarios)

    asked = [proposal(LEFT, number, number + 1) for number in range(4 * MAX_FAILURES)]
    reason, tally, _ = search(broken(fails_mostly), fixed(asked))
    assert (reason, tally.bad) == ("exhausted", {"failed": 4 * (MAX_FAILURES - 1)})
