"""Feed hostile grammar files to the reader and the binder: `python benchmarks/grammar_fuzz.py [INPUTS] [SEED]`.

Prints how often each outcome came up and the slowest inputs; exits with 1 if anything but a grammar or a diagnosis
came out, or if an input took longer than a second.
"""

from __future__ import annotations

import random
import resource
import sys
import traceback
from collections import Counter
from collections.abc import Iterator
from time import perf_counter

from hostile import explosive, mutated, outcome, random_text

SLOW = 1.0


def main(inputs: int = 100_000, seed: int = 0) -> int:
    """Run all inputs."""
    counts: Counter[str] = Counter()
    slowest: list[tuple[float, str, str]] = []
    bugs = 0
    for name, text in _inputs(inputs, seed):
        begin = perf_counter()
        try:
            counts[outcome(text)] += 1
        except Exception:  # noqa: BLE001  any other exception is what we look for
            bugs += 1
            print(f"BUG in {name}: {text!r}")
            traceback.print_exc()
        slowest = sorted([*slowest, (perf_counter() - begin, name, text)], reverse=True)[:5]
    print(", ".join(f"{code}: {number:,}" for code, number in counts.most_common()))
    for seconds, name, text in slowest:
        print(f"{seconds:.3f} s  {name}  {text[:60]!r}")
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{sum(counts.values()) + bugs:,} inputs, {bugs} bugs, at most {memory:.0f} MB")
    return int(bugs > 0 or slowest[0][0] > SLOW)


def _inputs(inputs: int, seed: int) -> Iterator[tuple[str, str]]:
    yield from explosive()
    rng = random.Random(seed)  # noqa: S311  nothing secret
    for number in range(inputs):
        yield (f"random {number}", random_text(rng)) if number % 2 else (f"mutated {number}", mutated(rng))


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
