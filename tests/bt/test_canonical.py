"""The canonical form against brute force."""

from __future__ import annotations

import time
from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import Action, Condition, Fallback, Sequence, Status, leaves, parse
from grammarbt.bt.canonical import MAX_NODES, all_pure, behave_alike, canonical_key, none_pure

ANSWERS = (Status.SUCCESS, Status.FAILURE, Status.RUNNING)
BOOLS = {True: Status.SUCCESS, False: Status.FAILURE}


class AskedError(Exception):
    """The tick has come to an action whose answer is still open."""


def exhaustive_behaviour(tree, interpret, conditions, history=()):
    """Everything a tick can do: for all values of the conditions before each action, and all answers of actions."""
    table = []
    for values in product(BOOLS, repeat=len(conditions)):
        worlds = [*history, values]
        asked = []

        def answer(leaf, worlds=worlds, asked=asked):
            if isinstance(leaf, Condition):
                return BOOLS[worlds[2 * len(asked)][conditions.index(leaf.name)]]
            asked.append(leaf)
            if 2 * len(asked) > len(worlds):
                raise AskedError
            return worlds[2 * len(asked) - 1]

        try:
            table.append(interpret(tree, answer))
        except AskedError:
            action = asked[-1]
            following = [exhaustive_behaviour(tree, interpret, conditions, (*worlds, s)) for s in ANSWERS]
            table.append((action, *following))
    return tuple(table)


def either(*items):
    """What one of the items derives; an item maps free leaves to its words, each with the leaves that are still free."""
    return lambda free: [found for item in items for found in item(free)]


def one_or_more(item):
    def many(free):
        return [
            found
            for text, rest in item(free)
            for found in [(text, rest), *((f"{text} {more}", left) for more, left in many(rest))]
        ]

    return many


def node(sign, first, second):
    return lambda free: [(f"{sign}( {one} {two} )", left) for one, rest in first(free) for two, left in second(rest)]


def words_of_table_one(actions, conditions):
    """Every sub-tree of a group by Table I, each leaf at most once; duplicates of ambiguous derivations removed."""

    def action(free):
        return [(f"[{name}]", free - {name}) for name in sorted(free & actions)]

    def condition(free):
        return [(f"({name})", free - {name}) for name in sorted(free & conditions)]

    def check(free):
        return [(word, rest) for text, rest in condition(free) for word in (text, f"!{text}")]

    fallback = either(node("?", action, one_or_more(action)), node("?", one_or_more(check), action))
    right, left = one_or_more(either(fallback, action)), one_or_more(either(fallback, condition))
    subtree = either(node("→", either(action, fallback), right), node("→", left, either(action, fallback)))
    return sorted({word for word, _ in subtree(actions | conditions)})


@pytest.mark.parametrize(
    ("actions", "conditions", "words", "behaviours"),
    [("a", "c", 1, 1), ("a", "cd", 8, 7), ("ab", "cd", 106, 86), ("ab", "cde", 1022, 578)],
)
def test_keys_are_equal_exactly_when_exhaustive_behaviour_is_on_table_one(
    actions, conditions, words, behaviours, interpret
):
    group = words_of_table_one(frozenset(actions), frozenset(conditions))
    trees = [parse(word) for word in group]
    pairs = {(canonical_key(tree), exhaustive_behaviour(tree, interpret, conditions)) for tree in trees}
    assert len(group) == words
    assert len(pairs) == len({key for key, _ in pairs}) == len({table for _, table in pairs}) == behaviours


@settings(max_examples=150, deadline=None)
@given(data=st.data())
def test_equal_keys_mean_equal_behaviour_with_parallel_nodes(data, small_trees, interpret):
    few_actions = small_trees.filter(lambda tree: sum(isinstance(leaf, Action) for leaf in leaves(tree)) <= 3)
    one, other = data.draw(few_actions), data.draw(few_actions)
    same = exhaustive_behaviour(one, interpret, "cd") == exhaustive_behaviour(other, interpret, "cd")
    assert behave_alike(one, other) == same


@settings(max_examples=100, deadline=None)
@given(data=st.data())
def test_laws_of_control_nodes_keep_the_level_one_key(data, any_trees):
    a, b, c = (data.draw(any_trees) for _ in range(3))
    key = canonical_key(Sequence((a, b, c)), none_pure)
    assert canonical_key(Sequence((a, Sequence((b, c)))), none_pure) == key
    assert canonical_key(Sequence((Sequence((a, b)), Fallback((c,)))), none_pure) == key


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("!( !( [a] ) )", "[a]"),
        ("!( →( [a] [b] ) )", "?( !([a]) !([b]) )"),
        ("→( (c) (d) [a] )", "→( (d) (c) [a] )"),
        ("?( →( (c) [a] ) →( !(c) [b] ) )", "?( →( (c) [a] ) →( !(c) [b] ) )"),
        ("‖1( (c) (d) )", "?( (c) (d) )"),
        ("→( (c) ?( (c) [a] ) )", "(c)"),
    ],
)
def test_these_behave_alike(one, other):
    assert behave_alike(parse(one), parse(other))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("→( [a] [a] )", "[a]"),
        ("→( [a] (c) )", "→( (c) [a] )"),
        ("?( (c) [a] )", "?( !(c) [a] )"),
        ("[x]", "(x)"),
        ("→( (c) [a] (c) )", "→( (c) [a] )"),
    ],
)
def test_these_do_not_behave_alike(one, other):
    assert not behave_alike(parse(one), parse(other))


def test_an_impure_condition_is_neither_moved_nor_merged():
    def only_d(condition):
        return condition.name == "d"

    assert not behave_alike(parse("→( (c) (c) [a] )"), parse("→( (c) [a] )"), only_d)
    assert not behave_alike(parse("→( (c) (d) [a] )"), parse("→( (d) (c) [a] )"), only_d)
    assert behave_alike(parse("→( (d) (d) [a] )"), parse("→( (d) [a] )"), only_d)


def test_keys_are_the_same_in_every_process(printed):
    text = "?( →( (c) (b) [x] ) →( !(b) [y] ) [z] )"
    imports = "from grammarbt.bt import parse; from grammarbt.bt.canonical import canonical_key"
    program = f"{imports}; print(canonical_key(parse({text!r})).hex())"
    assert printed(program) == {canonical_key(parse(text)).hex()}


def test_a_graph_that_would_grow_too_large_falls_back_to_level_one_quickly():
    pairs = " ".join(f"→( (a{i}) (b{i}) )" for i in range(40))
    tree = parse(f"?( {pairs} [x] )")
    begin = time.process_time()
    key = canonical_key(tree)
    assert time.process_time() - begin < 1
    assert key == canonical_key(tree, none_pure)
    assert len(key.splitlines()) < 3 * MAX_NODES


def test_thousands_of_conditions_are_no_trouble():
    names = " ".join(f"(c{i})" for i in reversed(range(5000)))
    assert canonical_key(parse(f"→( {names} )"), all_pure)
