"""The statistics agree with their definitions, and their intervals cover."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grammarbt.report.statistics import (
    bootstrap,
    holm,
    interquartile_mean,
    mean,
    mean_ranks,
    paired_p_value,
    probability_of_improvement,
    share,
)

FLOATS = st.floats(-1e6, 1e6)


def rng():
    return np.random.default_rng(5)


@given(st.lists(FLOATS, min_size=4, max_size=40).filter(lambda values: len(values) % 4 == 0))
def test_interquartile_mean_is_the_mean_of_the_middle_half(values):
    quarter = len(values) // 4
    middle = sorted(values)[quarter : len(values) - quarter]
    assert interquartile_mean(np.array(values)) == pytest.approx(np.mean(middle), abs=1e-6)


@given(st.lists(FLOATS, min_size=1, max_size=30))
def test_interquartile_mean_lies_within_the_values_and_ignores_their_order(values):
    found = interquartile_mean(np.array(values))
    assert min(values) - 1e-6 <= found <= max(values) + 1e-6
    assert found == pytest.approx(interquartile_mean(np.array(values[::-1])), abs=1e-6)


def test_bootstrap_interval_covers_the_true_mean_about_as_often_as_it_says():
    draw = np.random.default_rng(11)
    hits = 0
    for _ in range(100):
        interval = bootstrap(draw.normal(3.0, 1.0, 30).tolist(), mean, draw)
        hits += interval.low <= 3.0 <= interval.high
    assert 86 <= hits <= 100


def test_share_has_wilsons_interval():
    # Newcombe (1998), table I: 81 of 263.
    interval = share(81, 263)
    assert (round(interval.low, 4), round(interval.high, 4)) == (0.2553, 0.3662)
    assert share(20, 20).high == 1.0
    assert share(20, 20).low < 0.9


def test_probability_of_improvement_is_one_half_against_itself():
    values = [1.0, 2.0, 3.0, 4.0]
    assert probability_of_improvement(values, values, rng()).value == 0.5
    assert probability_of_improvement([5.0, 6.0], values, rng()).value == 1.0


@given(st.lists(st.lists(st.integers(0, 3), min_size=3, max_size=3), min_size=1, max_size=8))
def test_mean_ranks_add_up(rows):
    assert mean_ranks(np.array(rows, dtype=float)).sum() == pytest.approx(6.0)


def test_paired_test_is_exact_for_few_pairs():
    # All six differences have one sign: 2 of 64 sign patterns are as extreme.
    assert paired_p_value([2, 3, 4, 5, 6, 7], [1, 1, 1, 1, 1, 1], rng()) == 2 / 64


def test_paired_test_is_fair_under_the_null():
    draw = np.random.default_rng(3)
    found = [paired_p_value(draw.normal(size=10).tolist(), draw.normal(size=10).tolist(), draw) for _ in range(200)]
    assert sum(p <= 0.05 for p in found) <= 20


@given(st.lists(st.floats(0, 1), min_size=1, max_size=12))
def test_holm_keeps_the_order_and_never_lowers_a_p_value(values):
    adjusted = holm(values)
    assert all(after >= before for before, after in zip(values, adjusted, strict=True))
    ordered = [after for _, after in sorted(zip(values, adjusted, strict=True))]
    assert all(a <= b for a, b in pairwise(ordered))
