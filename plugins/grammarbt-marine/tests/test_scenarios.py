"""A scenario is one world with one noise, for every tree, process and batch."""

import subprocess
import sys
import threading

import numpy as np
import pytest

from grammarbt.bt import compile_policy, parse
from grammarbt.domain import scenario_numbers
from grammarbt_marine.references import REFERENCES
from grammarbt_marine.vocabulary import VOCABULARY

MANUAL = compile_policy(parse(REFERENCES[0].tree), VOCABULARY.index)

IN_ANOTHER_PROCESS = """
import numpy as np
from grammarbt.bt import compile_policy, parse
from grammarbt_marine.domain import Marine
marine = Marine()
policy = compile_policy(parse(marine.references[0].tree), marine.vocabulary.index)
print(marine.simulate(policy, np.arange(50)).returns.tolist())
"""


def test_another_process_gives_the_same_returns(marine):
    command = [sys.executable, "-c", IN_ANOTHER_PROCESS]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert printed.strip() == str(marine.simulate(MANUAL, np.arange(50)).returns.tolist())


def test_the_batch_does_not_matter(marine):
    scenarios = np.array([5, 900, 5, 3, 2**40 + 1])
    together = marine.simulate(MANUAL, scenarios)
    alone = [marine.simulate(MANUAL, np.array([scenario])) for scenario in scenarios]
    assert together.returns.tolist() == [outcome.returns[0] for outcome in alone]
    assert together.ticks.tolist() == sum(outcome.ticks for outcome in alone).tolist()


def test_no_scenarios_give_no_returns(marine):
    outcome = marine.simulate(MANUAL, np.arange(0))
    assert outcome.returns.shape == (0,)
    assert not outcome.ticks.any()


def test_read_only_and_strided_scenarios_are_welcome(marine):
    scenarios = np.arange(10)
    scenarios.flags.writeable = False
    expected = marine.simulate(MANUAL, np.arange(10)).returns
    assert marine.simulate(MANUAL, scenarios).returns.tolist() == expected.tolist()
    assert marine.simulate(MANUAL, scenarios[::2]).returns.tolist() == expected[::2].tolist()


def test_threads_may_share_a_domain(marine):
    expected = marine.simulate(MANUAL, np.arange(200)).returns.tolist()
    found = []
    threads = [
        threading.Thread(target=lambda: found.append(marine.simulate(MANUAL, np.arange(200)).returns.tolist()))
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 4


def test_leaves_that_change_nothing_do_not_change_the_noise(marine):
    idle = "?( →( (at surface) !(at surface) [disarm] ) →( (mine found) [random walk] ) [random walk] [report] )"
    scenarios = np.arange(300)
    longer, shorter = (compile_policy(parse(tree), VOCABULARY.index) for tree in (idle, "[random walk]"))
    assert marine.simulate(longer, scenarios).returns.tolist() == marine.simulate(shorter, scenarios).returns.tolist()


def test_run_seeds_share_roadmaps_and_nothing_else(marine):
    first, other = (marine.simulate(MANUAL, scenario_numbers(seed, 0, 2000)).returns for seed in (0, 1))
    assert first.mean() == pytest.approx(other.mean(), rel=0.02)
    assert abs(np.corrcoef(first, other)[0, 1]) < 0.5
