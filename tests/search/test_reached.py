"""Trees that go the ways of known ones."""

from itertools import count

import numpy as np
import pytest

from grammarbt.bt import Status, compile_policy, leaves, parse
from grammarbt.bt.compiler import compile_steps
from grammarbt.domain import ActionType, ConditionType, Group, TickDomain, Vocabulary
from grammarbt.search import reached
from grammarbt.search.reached import ReachedTrees
from grammarbt.testing.trees import wild_tree

TICKS = (3, 1, 0, 2)
TREE = parse("?( →( (c) [a] [b] ) [d] )")
SAME_WAYS = ("?( →( (c) [a] [d] [d] ) [d] )", "?( →( (c) →( [a] ) ) [d] )", "?( →( (c) [a] !([b]) ) ?( [d] ) )")
OTHER_WAYS = ("?( →( (c) [a] ) [b] )", "?( →( (c) [b] ) [d] )", "→( (c) [a] [b] )", "?( →( !(c) [a] [b] ) [d] )")


class Diary(TickDomain):
    """Each answer is drawn anew, so that what comes depends on all that was ticked before."""

    vocabulary = Vocabulary((Group("all", tuple(map(ActionType, "abd")), (ConditionType("c"),)),))

    def reset(self, rng):
        self.rng, self.reward, self.ticks = rng, 0.0, count(1)

    def condition(self, name):
        return bool(self.rng.random() < 0.5)

    def action(self, name):
        self.reward += "abd".index(name) * self.rng.random()
        return (Status.SUCCESS, Status.FAILURE, Status.RUNNING)[self.rng.integers(3)]

    def step(self):
        self.done = next(self.ticks) == 4


def goes_the_same_ways(tree, ticks, other):
    """By looking at both side by side."""
    one, two = compile_steps(tree), compile_steps(other)
    pairs, seen = [(one.first, two.first)], set()
    while pairs:
        a, b = pairs.pop()
        if min(a, b) < 0 or (a, b) in seen:
            if (a, b) not in seen and a != b and (a < 0 or ticks[one.steps[a][1]]):
                return False
            continue
        seen.add((a, b))
        if ticks[one.steps[a][1]]:
            if one.steps[a][0] != two.steps[b][0]:
                return False
            pairs += zip(one.steps[a][2:], two.steps[b][2:], strict=True)
    return True


def test_what_earned_something_where_ticks_arrive_earns_it_again():
    rng, known = np.random.default_rng(0), []
    trees, found, missed = ReachedTrees("behaviour"), 0, 0
    for _ in range(800):
        tree = wild_tree(rng, Diary.vocabulary.leaves, int(rng.integers(1, 7)))
        outcome = Diary().simulate(compile_policy(tree, Diary.vocabulary.index), np.array([1]))
        copy = trees.knows(tree)
        same = [earned for one, ticks, earned in known if goes_the_same_ways(one, ticks, tree)]
        missed += bool(same) and not copy
        if copy:
            found += 1
            assert outcome.returns[0] in same
        else:
            known.append((tree, outcome.ticks, outcome.returns[0]))
            trees.add(tree, outcome.ticks.tolist())
    assert 50 < found < 700
    assert missed < found / 20  # such as where one tree goes on alike in two places, and the other in one


@pytest.mark.parametrize("text", SAME_WAYS)
def test_what_was_never_ticked_makes_no_difference(text):
    trees = ReachedTrees("behaviour")
    trees.add(TREE, TICKS)
    assert trees.knows(parse(text))


@pytest.mark.parametrize("text", OTHER_WAYS)
def test_what_goes_another_way_is_not_known(text):
    trees = ReachedTrees("behaviour")
    trees.add(TREE, TICKS)
    assert not trees.knows(parse(text))


def test_where_the_tree_itself_counts_a_smaller_one_is_not_known():
    trees = ReachedTrees("tree")
    trees.add(TREE, TICKS)
    smaller, larger = parse("?( →( (c) [a] ) [d] )"), parse("?( →( (c) [a] [b] [b] ) [d] )")
    assert trees.knows(larger)
    assert not trees.knows(smaller)
    trees.add(parse("?( →( (c) [a] [d] [d] ) [d] )"), (3, 1, 0, 0, 2))
    assert trees.knows(larger)


def test_without_ticks_nothing_is_known():
    trees = ReachedTrees("behaviour")
    trees.add(TREE, ())
    trees.add(TREE, (0, 0, 0, 0))
    assert not trees.knows(TREE)


def test_what_is_known_does_not_grow_for_ever(monkeypatch):
    monkeypatch.setattr(reached, "MOST_PLACES", 40)
    trees, rng = ReachedTrees("behaviour"), np.random.default_rng(0)
    shown = [wild_tree(rng, Diary.vocabulary.leaves, 6) for _ in range(200)]
    for tree in shown:
        trees.add(tree, [1] * len(leaves(tree)))
        assert trees.knows(tree)
    assert sum(map(trees.knows, shown)) < 50
