"""Trees of all kinds, and how often an episode ticks their leaves."""

from collections import Counter

from grammarbt.bt import Action, Condition, Fallback, Not, Parallel, Sequence, leaves
from grammarbt.domain.plain import play


def played(world, tree):
    """The return of an episode in plain Python, and how often each leaf was ticked."""
    counts = Counter(occurrence for tick in play(world, tree) for occurrence, _ in tick)
    return world.reward, [counts[occurrence] for occurrence in range(len(leaves(tree)))]


def wild_tree(rng, options, size):
    """Any nesting of all kinds of nodes."""
    if size <= 1:
        return options[rng.integers(len(options))]
    if rng.random() < 0.15:
        return Not(wild_tree(rng, options, size - 1))
    parts = tuple(wild_tree(rng, options, rng.integers(1, max(2, size // 2))) for _ in range(rng.integers(2, 5)))
    if rng.random() < 0.15:
        return Parallel(parts, rng.integers(1, len(parts), endpoint=True))
    return (Fallback, Sequence)[rng.integers(2)](parts)


def kinds_of(nodes):
    return {type(node) for node in nodes}


EVERY_KIND = {Action, Condition, Fallback, Not, Parallel, Sequence}
