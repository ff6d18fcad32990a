"""The default parameters make every group of leaves matter, by known amounts."""

import numpy as np
import pytest

from grammarbt.bt import Fallback, compile_policy, format_tree, parse
from grammarbt_marine.domain import Marine
from grammarbt_marine.parameters import MarineParameters
from grammarbt_marine.references import REFERENCES

EPISODES = 5_000
MANUAL = parse(REFERENCES[0].tree)
BEST_ORDER = parse(REFERENCES[1].tree)
THOROUGH = parse(REFERENCES[2].tree)
MANUAL_MEAN = 145.65


@pytest.fixture(scope="module")
def share(returns):
    """A tree's mean return, as a share of the manual tree's."""
    whole = returns(format_tree(MANUAL), EPISODES).mean()
    return lambda tree: returns(format_tree(tree), EPISODES).mean() / whole


def test_the_manual_tree_earns_what_it_should(returns):
    assert returns(format_tree(MANUAL), 20_000).mean() == pytest.approx(MANUAL_MEAN, rel=0.03)


@pytest.mark.parametrize(("place", "left"), [(0, 0.57), (1, 0.75), (2, 0.69), (3, 0.76), (4, 0.62)])
def test_without_one_of_its_subtrees_the_manual_tree_earns_so_much_less(place, left, share):
    rest = MANUAL.children[:place] + MANUAL.children[place + 1 :]
    assert share(Fallback(rest)) == pytest.approx(left, abs=0.05)


def test_the_best_order_of_the_same_subtrees_earns_a_little_more(share):
    assert sorted(map(format_tree, BEST_ORDER.children)) == sorted(map(format_tree, MANUAL.children))
    assert share(BEST_ORDER) == pytest.approx(1.02, abs=0.01)


def test_where_things_are_few_the_thorough_tree_is_much_better_and_does_without_a_random_walk():
    marine = Marine(MarineParameters("sparse"))
    manual, thorough, seated = (
        marine.simulate(compile_policy(tree, marine.vocabulary.index), np.arange(EPISODES)).returns.mean()
        for tree in (MANUAL, THOROUGH, Fallback(THOROUGH.children[:-1]))
    )
    assert thorough / manual == pytest.approx(1.28, abs=0.03)
    assert seated / thorough > 0.97
