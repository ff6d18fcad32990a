"""Counting is exact: known figures, and brute force on whatever is small enough to list."""

import json
import re
from itertools import product

import numpy as np
import pytest

from grammarbt.bt.canonical import canonical_key
from grammarbt.cli import main
from grammarbt.errors import GrammarError
from grammarbt.grammar import Source, bind, load_grammar, shipped_grammars
from grammarbt.grammar.automaton import Language
from grammarbt.grammar.count import Count, Counter, distinct_words
from grammarbt.grammar.paths import InfiniteLanguageError, TooLargeError
from grammarbt.grammar.uniform import Uniform

OVERLAPPING = """
%declare ACTION CONDITION
%forall g in GROUP
%unique g in start
start: "?" "(" each+ ")"
each: one{g} | two{g}
one{g}: "→" "(" ACTION "[a1.0]" ")" | "!" "(" "(c1.0)" ")" | "(c1.0)"
two{g}: "→" "(" ACTION ACTION ")" | "(c1.0)"
"""
"""Blocks with common words; also wrapped into one another."""

WRAPPED = """
%declare CONDITION
%forall g in GROUP
%unique g in start
start: "?" "(" each+ ")"
each: part{g} | "!" "(" part{g} ")"
part{g}: CONDITION{g} | "!" "(" CONDITION{g} ")"
"""
"""A block and its surroundings can spell the same."""


def language(text, vocabulary):
    return Language(bind(load_grammar(Source("test.grammar", text)), vocabulary))


def brute_force(bound, symbol):
    derivations = list(bound.enumerate(symbol))
    words = {word for _, word in derivations}
    behaviours = {canonical_key(bound.tree_of(word)) for word in words}
    return Count(len(derivations), len(words), len(behaviours))


@pytest.mark.parametrize("name", ["scheide", "marine"])
@pytest.mark.parametrize("sizes", [((1, 1), (1, 2)), ((2, 1), (1, 0), (1, 1)), ((2, 2), (2, 0))])
def test_counts_of_shipped_grammars_equal_brute_force(bound, name, sizes):
    grammar = bound(name, *sizes)
    counter = Counter(Language(grammar))
    for symbol in (grammar.start_symbol, *grammar.blocks):
        assert counter.count(symbol) == brute_force(grammar, symbol)


@pytest.mark.parametrize(("name", "nodes"), [("general", 6), ("perez", 8), ("ppa", 9), ("sized", 8)])
def test_counts_of_shipped_grammars_cut_to_a_few_nodes_equal_brute_force(vocabulary, name, nodes):
    text = re.sub(r"%limit nodes \d+", f"%limit nodes {nodes}", shipped_grammars()[name].text)
    counted = language(text, vocabulary((1, 1)))
    start = counted.bound.start_symbol
    expected = brute_force(counted.bound, start)
    assert Counter(counted).count(start) == expected
    assert expected.words < 20_000


def test_groups_of_table_one_have_the_known_counts(bound):
    groups = Counter(Language(bound("scheide", (1, 1), (1, 2), (2, 2), (2, 3)))).groups()
    assert list(groups.values()) == [Count(1, 1, 1), Count(8, 8, 7), Count(146, 106, 86), Count(1418, 1022, 578)]


def test_whole_marine_languages_have_the_known_numbers_of_words(bound, marine_sizes):
    sizes = {name: bound(name, *marine_sizes) for name in ("scheide", "marine")}
    words = {name: Counter(Language(grammar)).words(grammar.start_symbol) for name, grammar in sizes.items()}
    assert words == {"scheide": 26_940_800, "marine": 20_393_448_780}


def test_groups_of_the_repaired_grammar_have_the_known_behaviours(bound, marine_sizes):
    groups = Counter(Language(bound("marine", *marine_sizes))).groups()
    assert [count.behaviours for count in groups.values()] == [1076, 17, 132, 3, 1, 1]


def test_groups_without_a_word_count_nothing(bound, marine_sizes):
    groups = Counter(Language(bound("scheide", *marine_sizes))).groups()
    assert groups["g5"] == groups["g6"] == Count(0, 0, 0)


@pytest.mark.parametrize("text", [OVERLAPPING, WRAPPED])
@pytest.mark.parametrize("sizes", [((1, 1),), ((2, 1), (1, 1)), ((1, 1), (1, 2), (1, 1))])
def test_blocks_that_can_be_mistaken_for_something_else_are_counted_exactly(vocabulary, text, sizes):
    counted = language(text, vocabulary(*sizes))
    start = counted.bound.start_symbol
    assert counted.contained
    assert Counter(counted).count(start) == brute_force(counted.bound, start)
    words = list(distinct_words(counted, start))
    assert len(words) == len(set(words))
    assert set(words) == {word for _, word in counted.bound.enumerate()}


@pytest.mark.parametrize(("nodes", "depth"), list(product((3, 4, 5), (2, 3))))
def test_limited_grammars_equal_brute_force(vocabulary, nodes, depth):
    limits = f"%limit nodes {nodes}\n%limit depth {depth}\n"
    text = f'%declare ACTION\n{limits}start: "?" "(" t+ ")"\nt: "→" "(" t t+ ")" | ACTION | t2\nt2: ACTION | t3\nt3: "!" "(" t ")"\n'
    counted = language(text, vocabulary((2, 0)))
    start = counted.bound.start_symbol
    assert Counter(counted).count(start) == brute_force(counted.bound, start)


@pytest.mark.parametrize(
    "rule",
    ["t: ACTION t | ACTION", "t: t ACTION | ACTION", 't: "→" "(" t t ")" | ACTION', "t: u\nu: ACTION t | ACTION"],
)
def test_infinite_languages_are_told_apart_at_once(vocabulary, rule):
    endless = language(f'%declare ACTION\nstart: "?" "(" t ")"\n{rule}\n', vocabulary((2, 2)))
    with pytest.raises(InfiniteLanguageError, match="infinitely many"):
        Counter(endless).words(endless.bound.start_symbol)


def test_a_language_too_large_to_count_is_an_error_and_not_a_stall(vocabulary, monkeypatch):
    monkeypatch.setattr("grammarbt.grammar.paths.MAX_NODES", 20)
    text = '%declare ACTION\n%unique ACTION in start\nstart: "?" "(" ACTION+ ")"\n'
    huge = language(text, vocabulary((30, 0)))
    with pytest.raises(TooLargeError, match="passes 20 nodes") as caught:
        Counter(huge).words(huge.bound.start_symbol)
    assert isinstance(caught.value, GrammarError)
    assert Counter(huge).count(huge.bound.start_symbol) == Count(None, None, None)


def test_graphs_for_counting_merge_leaves_that_are_alike_and_count_the_same(bound):
    grammar = bound("marine", (3, 3), (1, 1))
    language = Language(grammar)
    for exact, merged in (
        (language.words, language.words_to_count),
        (language.derivations, language.derivations_to_count),
    ):
        assert len(merged(grammar.blocks[0]).edges) < len(exact(grammar.blocks[0]).edges) / 3
    counter = Counter(Language(grammar))
    assert counter.words(grammar.blocks[0]) == sum(1 for _ in distinct_words(language, grammar.blocks[0]))
    assert counter.derivations(grammar.blocks[0]) == Uniform(language, grammar.blocks[0], derivations=True).total


MIXED = """
%declare ACTION CONDITION
%unique ACTION in start
%unique ACTION CONDITION in part
start: "?" "(" part part ACTION ")"
part: "→" "(" guard* (ACTION | "[a1.0]") ")" | "→" "(" "[a1.1]" guard ")"
guard: CONDITION | "!" "(" CONDITION ")"
"""
"""Some leaves are alike, others are named; scopes lie in one another."""


@pytest.mark.parametrize("sizes", [((3, 2),), ((4, 1),), ((2, 2), (1, 0))])
def test_leaves_that_the_grammar_names_are_not_taken_for_others(vocabulary, sizes):
    counted = language(MIXED, vocabulary(*sizes))
    start = counted.bound.start_symbol
    assert len(counted.symmetry.classes) >= 1
    assert Counter(counted).count(start) == brute_force(counted.bound, start)


def test_a_group_of_five_actions_and_five_conditions_is_counted_and_its_behaviours_are_too_many(bound):
    grammar = bound("scheide", (5, 5), (5, 5))
    counter = Counter(Language(grammar))
    assert list(counter.groups().values()) == [Count(383_258_045, 324_377_065, None)] * 2
    assert counter.count(grammar.start_symbol).words == 2 * 324_377_065**2


def test_derivations_of_the_whole_language_follow_from_the_blocks(bound):
    grammar = bound("scheide", (1, 2), (2, 2))
    counter = Counter(Language(grammar))
    assert counter.derivations(grammar.start_symbol) == 2 * np.prod([8, 146])


def test_the_command_prints_one_object_with_every_group_and_the_whole(capsys):
    assert main(["grammar", "count", "marine", "--domain", "marine", "--json"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["words"] == 20_393_448_780
    assert [group["words"] for group in result["groups"].values()] == [1876, 21, 164, 3, 1, 1]
    assert [group["behaviours"] for group in result["groups"].values()] == [1076, 17, 132, 3, 1, 1]


def test_the_command_prints_a_table_for_people(capsys):
    assert main(["grammar", "count", "scheide", "--domain", "marine"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].split() == ["g1", "1,418", "1,022", "578"]
    assert "26,940,800" in lines[-1]


def test_an_infinite_language_is_a_mistake_with_a_hint(capsys, tmp_path):
    file = tmp_path / "endless.grammar"
    file.write_text('%declare ACTION\nstart: "?" "(" ACTION+ ")"\n', encoding="utf-8")
    for verb in ("count", "sample"):
        assert main(["grammar", verb, str(file), "--domain", "marine"]) == 2
        error = capsys.readouterr().err
        assert "infinitely many" in error
        assert "%limit nodes" in error
    assert main(["grammar", "sample", str(file), "--domain", "marine", "--uniform", "choices"]) == 0


def test_groups_that_only_the_whole_trees_limit_keeps_finite_do_not_hide_the_whole(capsys, tmp_path):
    (tmp_path / "x.grammar").write_text(
        "%declare ACTION CONDITION\n%forall g in GROUP\n%limit nodes 8\n"
        'start: "?" "(" each each+ ")"\neach: part{g}\npart{g}: "→" "(" CONDITION{g} ACTION{g}+ ")"\n',
        encoding="utf-8",
    )
    assert main(["grammar", "count", str(tmp_path / "x.grammar"), "--domain", "marine", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["groups"]["g1"]["words"] is None
    assert main(["grammar", "check", str(tmp_path / "x.grammar"), "--domain", "marine", "--json"]) == 0
    assert found["words"] == json.loads(capsys.readouterr().out)["summary"]["words"] > 0
