"""The languages of the shipped grammars, by enumeration."""

from itertools import combinations, permutations
from math import factorial, prod

import numpy as np
import pytest

from grammarbt.bt import format_tree, parse


def block_counts(bound, block):
    derivations = list(bound.enumerate(block))
    return len(derivations), len({word for _, word in derivations})


def trees_of_two_or_more(counts):
    """Ordered choices of at least two groups, one sub-tree each."""
    sizes = range(2, len(counts) + 1)
    return sum(factorial(k) * sum(map(prod, combinations(counts, k))) for k in sizes)


@pytest.mark.parametrize(
    ("size", "derivations", "words"),
    [((1, 1), 1, 1), ((1, 2), 8, 8), ((2, 2), 146, 106), ((2, 3), 1418, 1022)],
)
def test_table_one_has_the_known_counts_per_group(bound, size, derivations, words):
    grammar = bound("scheide", size, (1, 1))
    assert block_counts(grammar, grammar.blocks[0]) == (derivations, words)


def test_table_one_has_no_word_for_a_group_of_one_action(bound, marine_sizes):
    grammar = bound("scheide", *marine_sizes)
    assert [grammar.nonterminal_name(block) for block in grammar.blocks] == [f"subtree{{g{n}}}" for n in (1, 2, 3, 4)]
    counts = [block_counts(grammar, block)[1] for block in grammar.blocks]
    assert trees_of_two_or_more(counts) == 26_940_800


def test_repaired_grammar_gives_every_marine_group_its_words(bound, marine_sizes):
    grammar = bound("marine", *marine_sizes)
    counts = [block_counts(grammar, block)[1] for block in grammar.blocks]
    assert counts == [1876, 21, 164, 3, 1, 1]
    assert trees_of_two_or_more(counts) == 20_393_448_780


def test_counts_by_blocks_equal_counts_by_whole_derivations(bound):
    grammar = bound("scheide", (1, 1), (1, 2), (1, 2))
    words = {word for _, word in grammar.enumerate()}
    assert len(words) == trees_of_two_or_more([1, 8, 8])


def test_every_word_is_a_tree_that_the_notation_reads_back(bound):
    grammar = bound("scheide", (1, 1), (1, 2))
    for _, word in grammar.enumerate():
        tree = grammar.tree_of(word)
        assert parse(format_tree(tree)) == tree


@pytest.mark.parametrize("name", ["scheide", "marine"])
def test_random_derivations_keep_the_constraints(bound, marine_sizes, name):
    grammar, rng = bound(name, *marine_sizes), np.random.default_rng(1)
    for _ in range(500):
        tree = grammar.tree(grammar.derive(grammar.sample(rng)))
        groups = []
        for subtree in tree.children:
            names = [leaf for leaf in format_tree(subtree).replace("!", " ").split() if leaf[0] in "[("]
            assert len(names) == len(set(names))
            groups.append({name[2:].split(".")[0] for name in names if "." in name})
        assert all(len(own) == 1 for own in groups)
        assert not any(one & other for one, other in combinations(groups, 2))


def test_any_order_reaches_the_words_that_leftmost_order_reaches(bound):
    grammar = bound("scheide", (1, 2), (1, 1))
    seen, queue, words = set(), [grammar.start()], set()
    while queue:
        form = queue.pop()
        if form in seen:
            continue
        seen.add(form)
        if grammar.is_word(form):
            words.add(grammar.tree(form))
        for position in grammar.positions(form):
            legal = grammar.legal(form, position)
            assert legal, grammar.text(form)
            queue += [grammar.apply(form, number, position) for number in legal]
    assert words == {grammar.tree_of(word) for _, word in grammar.enumerate()}
    for form in seen - {grammar.start()}:
        above = {(parent, number) for parent, number in grammar.parents(form) if parent in seen}
        assert all(
            any(grammar.legal(parent, at) and number in grammar.legal(parent, at) for at in grammar.positions(parent))
            for parent, number in above
        )
        assert above, grammar.text(form)


def test_forms_of_a_marine_block_in_leftmost_order_and_in_any_order(bound):
    grammar = bound("scheide", (2, 3), (1, 1))
    forms, queue = set(), [grammar.start(grammar.blocks[0])]
    while queue:
        form = queue.pop()
        if form not in forms:
            forms.add(form)
            if not grammar.is_word(form):
                queue += [grammar.apply(form, number) for number in grammar.legal(form)]
    assert len({form for form in forms if grammar.is_word(form)}) == 1022


def test_extra_productions_spell_the_sub_trees_they_stand_for(bound, marine_sizes):
    grammar, rng = bound("scheide", *marine_sizes), np.random.default_rng(3)
    block = grammar.blocks[0]
    found = [grammar.sample(rng, block) for _ in range(3)]
    larger = grammar.extended(block, found)
    added = range(len(grammar.productions), len(larger.productions))
    assert [larger.base_derivation((number,)) for number in added] == found
    for number, derivation in zip(added, found, strict=True):
        assert larger.derive((number,), block) == grammar.derive(derivation, block)
    assert set(added) <= set(larger.legal(larger.start(block)))
    for _ in range(200):
        derivation = larger.sample(rng)
        assert grammar.derive(larger.base_derivation(derivation)) == larger.derive(derivation)


def test_fingerprint_and_numbers_do_not_depend_on_the_hash_seed(run_python):
    code = (
        "from pathlib import Path; from grammarbt.grammar import *; from grammarbt.bt.vocabulary import *\n"
        "v = Vocabulary(tuple(Group(n, (ActionType('a'+n),), (ConditionType('c'+n),)) for n in 'xyz'))\n"
        "b = bind(load_grammar(shipped_grammars()['scheide']), v)\n"
        "print(b.fingerprint, b.productions, b.blocks)"
    )
    assert run_python(code, "1") == run_python(code, "2")


def test_permuted_groups_are_the_same_language(bound):
    sizes = [(1, 1), (1, 2), (2, 1)]
    counts = set()
    for order in permutations(sizes):
        grammar = bound("scheide", *order)
        counts.add(tuple(sorted(block_counts(grammar, block) for block in grammar.blocks)))
    assert len(counts) == 1
