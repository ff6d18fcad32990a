"""Feed hostile grammar files to the reader and the binder: `python benchmarks/grammar_fuzz.py [INPUTS] [SEED]`.

Prints how often each outcome came up, the share that the binder saw, and the slowest inputs by the process's own clock;
exits with 1 if anything but a tree, an endless language or a diagnosis came out, or if an input took longer than a second.
"""

from __future__ import annotations

import random
import resource
import sys
import traceback
from collections import Counter
from collections.abc import Iterator
from itertools import cycle
from time import process_time

from hostile import edited, explosive, mutated, outcome, random_text

SLOW = 1.0


def main(inputs: int = 100_000, seed: int = 0) -> int:
    """Run all inputs."""
    counts: Counter[str] = Counter()
    slowest: list[tuple[float, str, str]] = []
    bugs = reached = 0
    for name, text in _inputs(inputs, seed):
        begin = process_time()
        try:
            code, bound = outcome(text)
            counts[code] += 1
            reached += bound
        except Exception:  # noqa: BLE001  any other exception is what we look for
            bugs += 1
            print(f"BUG in {name}: {text!r}")
            traceback.print_exc()
        slowest = sorted([*slowest, (process_time() - begin, name, text)], reverse=True)[:5]
    print(", ".join(f"{code}: {number:,}" for code, number in counts.most_common()))
    for seconds, name, text in slowest:
        print(f"{seconds:.3f} s  {name}  {text[:60]!r}")
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    total = sum(counts.values()) + bugs
    print(f"{total:,} inputs, {reached / total:.0%} reached the binder, {bugs} bugs, at most {memory:.0f} MB")
    return int(bugs > 0 or slowest[0][0] > SLOW)


def _inputs(inputs: int, seed: int) -> Iterator[tuple[str, str]]:
    yield from explosive()
    rng = random.Random(seed)  # noqa: S311  nothing secret
    kinds = {"random": random_text, "mutated": mutated, "edited": edited, "edited again": edited}
    for number, (name, make) in zip(range(inputs), cycle(kinds.items()), strict=False):
        yield f"{name} {number}", make(rng)


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
