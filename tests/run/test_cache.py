"""The cache is bounded, and what it forgets depends on the order of the trials alone."""

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grammarbt.run.cache import Known, ReturnCache
from grammarbt.run.evaluate import Evaluator

ROOM = 20  # two trees with two returns each: a tree counts as eight returns


def learn(cache, name, scenarios):
    known = cache.get(name)
    known.learn(scenarios, [float(number) for number in scenarios])
    cache.keep({name: known}, len(scenarios))


def names(cache):
    return [key for key, _ in cache.items()]


def test_the_tree_used_longest_ago_is_forgotten_first():
    cache = ReturnCache(ROOM)
    learn(cache, b"a", [0, 1])
    learn(cache, b"b", [0, 1])
    assert names(cache) == [b"a", b"b"]
    cache.keep({b"a": cache.get(b"a")}, 0)
    learn(cache, b"c", [0])
    assert names(cache) == [b"a", b"c"]
    assert cache.get(b"b").returns == {}
    assert (cache.get(b"a").returns, cache.get(b"a").mean) == ({0: 0.0, 1: 1.0}, 0.5)


def test_a_tree_with_more_returns_than_there_is_room_for_is_not_kept():
    cache = ReturnCache(ROOM)
    learn(cache, b"a", range(100))
    assert len(cache) == 0


def test_a_tree_of_which_nothing_is_known_takes_no_room():
    cache = ReturnCache(ROOM)
    cache.keep({b"a": Known()}, 0)
    assert len(cache) == 0


@given(st.lists(st.tuples(st.sampled_from([b"a", b"b", b"c", b"d"]), st.integers(1, 4))))
def test_the_room_is_never_exceeded(uses):
    cache, step = ReturnCache(ROOM), 0
    for name, number in uses:
        learn(cache, name, range(step, step + number))
        step += number
        assert sum(8 + len(known.returns) for _, known in cache.items()) <= ROOM


@given(batch=st.integers(1, 40))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_what_is_forgotten_does_not_depend_on_what_is_simulated_side_by_side(lamps, proposal, batch):
    trees = ["[light left]", "[light right]", "(left lit)", "(right lit)"]
    asked = [proposal(trees[at % 7 % 4], at % 4, at % 4 + at % 3 + 1) for at in range(80)]
    free, tight = (Evaluator(lamps(), 0, cache=ReturnCache(ROOM)) for _ in range(2))
    for first in range(0, len(asked), batch):
        part = asked[first : first + batch]
        # A limit that only just suffices allows no overtaking, and so gives other waves.
        least = sum(trial.simulated for trial in free.evaluate(part, 10**6))
        tight.evaluate(part, least)
        assert names(tight.cache) == names(free.cache)
        assert tight.episodes == free.episodes


def test_what_was_forgotten_is_simulated_again_to_the_same_returns(lamps, proposal):
    evaluator = Evaluator(lamps(), 0, cache=ReturnCache(ROOM))
    first = evaluator.evaluate([proposal("[light left]", 0, 3)], 100)[0]
    evaluator.evaluate([proposal("[light right]", 0, 10)], 100)
    again = evaluator.evaluate([proposal("[light left]", 0, 3)], 100)[0]
    assert again == first
    assert evaluator.episodes == 16
