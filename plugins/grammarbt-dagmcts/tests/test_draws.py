from collections import Counter

import numpy as np

from grammarbt_dagmcts.draws import DRAWN_AT_ONCE, Draws


def test_each_number_drawn_is_handed_out_once():
    draws, rng = Draws(np.random.default_rng(3)), np.random.default_rng(3)
    taken = [draws.ready(n).pop() for n in (1, 5, 900, 2, 1_500) for _ in range(n)]
    many = -(-len(taken) // DRAWN_AT_ONCE) + 1
    assert len(set(taken)) == len(taken)
    assert set(taken) <= set(rng.random(many * DRAWN_AT_ONCE).tolist())


def test_the_same_seed_gives_the_same_numbers():
    one, other = Draws(np.random.default_rng(5)), Draws(np.random.default_rng(5))
    assert [one.below(7) for _ in range(3_000)] == [other.below(7) for _ in range(3_000)]


def test_all_numbers_below_a_bound_are_equally_likely():
    draws = Draws(np.random.default_rng(1))
    found = Counter(draws.below(5) for _ in range(50_000))
    assert sorted(found) == [0, 1, 2, 3, 4]
    assert all(abs(many - 10_000) < 400 for many in found.values())
