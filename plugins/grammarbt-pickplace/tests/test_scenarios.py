"""A scenario is one world with one noise, for every tree, process and batch."""

import subprocess
import sys

import numpy as np
import pytest

from grammarbt.bt import compile_policy, parse
from grammarbt.domain import scenario_numbers
from grammarbt_pickplace.domain import PickPlace
from grammarbt_pickplace.parameters import PickPlaceParameters

DOMAIN = PickPlace(PickPlaceParameters("S2", stochastic=True))
BEST = compile_policy(parse(DOMAIN.references[0].tree), DOMAIN.vocabulary.index)

IN_ANOTHER_PROCESS = """
import numpy as np
from grammarbt.bt import compile_policy, parse
from grammarbt_pickplace.domain import PickPlace
from grammarbt_pickplace.parameters import PickPlaceParameters
domain = PickPlace(PickPlaceParameters("S2", stochastic=True))
policy = compile_policy(parse(domain.references[0].tree), domain.vocabulary.index)
print(domain.simulate(policy, np.arange(50)).returns.tolist())
"""


def test_another_process_gives_the_same_returns():
    command = [sys.executable, "-c", IN_ANOTHER_PROCESS]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert printed.strip() == str(DOMAIN.simulate(BEST, np.arange(50)).returns.tolist())


def test_the_batch_does_not_matter():
    scenarios = np.array([5, 900, 5, 3, 2**40 + 1])
    together = DOMAIN.simulate(BEST, scenarios)
    alone = [DOMAIN.simulate(BEST, np.array([scenario])) for scenario in scenarios]
    assert together.returns.tolist() == [outcome.returns[0] for outcome in alone]
    assert together.ticks.tolist() == sum(outcome.ticks for outcome in alone).tolist()


def test_no_scenarios_give_no_returns():
    outcome = DOMAIN.simulate(BEST, np.arange(0))
    assert outcome.returns.shape == (0,)
    assert not outcome.ticks.any()


def test_read_only_and_strided_scenarios_are_welcome():
    scenarios = np.arange(10)
    scenarios.flags.writeable = False
    expected = DOMAIN.simulate(BEST, np.arange(10)).returns
    assert DOMAIN.simulate(BEST, scenarios[::2]).returns.tolist() == expected[::2].tolist()


def test_run_seeds_share_no_noise_but_the_same_mean():
    first, other = (DOMAIN.simulate(BEST, scenario_numbers(seed, 0, 20_000)).returns for seed in (0, 1))
    standard_error = first.std() / np.sqrt(first.size)
    assert first.mean() == pytest.approx(other.mean(), abs=6 * standard_error)
    assert abs(np.corrcoef(first, other)[0, 1]) < 0.05
