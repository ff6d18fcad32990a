from hypothesis import given
from hypothesis import strategies as st

from grammarbt.run.cache import Known, ReturnCache
from grammarbt.run.packing import packed, unpack

KEYS = st.binary(min_size=16, max_size=16)
RETURNS = st.dictionaries(st.integers(0, 2**31), st.floats(allow_nan=False, allow_infinity=False), min_size=1)


def contents(cache):
    return [(key, list(known.returns.items()), known.total) for key, known in cache.items()]


@given(trees=st.dictionaries(KEYS, RETURNS))
def test_what_is_packed_is_unpacked_in_its_order(trees):
    cache, other = ReturnCache(), ReturnCache()
    for key, returns in trees.items():
        known = Known()
        known.learn(list(returns), list(returns.values()))
        cache.keep({key: known}, len(returns))
    unpack(packed(cache), other)
    assert contents(other) == contents(cache)


def test_a_thousand_returns_fit_into_sixty_kilobytes():
    cache = ReturnCache()
    for number in range(1_000):
        known = Known()
        known.learn([number], [number / 3])
        cache.keep({number.to_bytes(16): known}, 1)
    assert sum(map(len, packed(cache).values())) < 60_000
