"""Uniform draws: exact in rank, even in frequency, the same for the same seed."""

import numpy as np
import pytest

from grammarbt.bt import format_tree, parse
from grammarbt.cli import main
from grammarbt.grammar.automaton import Language
from grammarbt.grammar.uniform import Uniform, draw_ranks, sampler

CHI_SQUARED_SLACK = 5
"""Standard deviations of chi-squared, √(2·degrees of freedom), around its mean; far beyond chance at a fixed seed."""


def chi_squared_is_plausible(counts, expected):
    statistic, freedom = float(np.sum((counts - expected) ** 2 / expected)), len(counts) - 1
    return abs(statistic - freedom) < CHI_SQUARED_SLACK * np.sqrt(2 * freedom)


@pytest.mark.parametrize("derivations", [False, True])
@pytest.mark.parametrize(("name", "sizes"), [("scheide", ((1, 2), (1, 1), (2, 2))), ("marine", ((2, 1), (1, 1)))])
def test_ranks_list_every_word_or_derivation_once(bound, name, sizes, derivations):
    grammar = bound(name, *sizes)
    uniform = Uniform(Language(grammar), derivations=derivations)
    found = [uniform.ranking.unrank(rank) for rank in range(uniform.total)]
    listed = {pair[not derivations] for pair in grammar.enumerate()}
    assert len(found) == len(listed)
    assert set(found) == listed


def test_words_come_equally_often_although_some_have_more_derivations(bound):
    grammar, rng = bound("scheide", (2, 2), (1, 1)), np.random.default_rng(0)
    uniform = Uniform(Language(grammar))
    words = uniform.draw(rng, 100 * uniform.total)
    _, counts = np.unique([text_key(word) for word in words], return_counts=True)
    assert len(counts) == uniform.total == 212
    assert chi_squared_is_plausible(counts, 100)


def text_key(word):
    return ",".join(map(str, word))


def test_derivations_come_equally_often_so_that_ambiguous_words_come_oftener(bound):
    grammar, rng = bound("scheide", (2, 2), (1, 1)), np.random.default_rng(0)
    uniform = Uniform(Language(grammar), derivations=True)
    drawn = uniform.draw(rng, 50 * uniform.total)
    _, counts = np.unique([text_key(derivation) for derivation in drawn], return_counts=True)
    assert len(counts) == uniform.total == 292
    assert chi_squared_is_plausible(counts, 50)


def test_the_test_notices_uneven_draws(bound):
    grammar, rng = bound("scheide", (2, 2), (1, 1)), np.random.default_rng(0)
    words = [grammar.leftmost.random_walk(grammar.start(), rng)[1] for _ in range(21_200)]
    _, counts = np.unique([text_key(word) for word in words], return_counts=True)
    assert not chi_squared_is_plausible(counts, 21_200 / len(counts))


def test_the_same_seed_draws_the_same_words(bound, marine_sizes):
    language = Language(bound("marine", *marine_sizes))
    first, second = (Uniform(language).draw(np.random.default_rng(4), 500) for _ in range(2))
    assert first == second
    assert first != Uniform(language).draw(np.random.default_rng(5), 500)


def test_drawn_words_belong_to_the_grammar_and_keep_its_constraints(bound, marine_sizes):
    grammar, rng = bound("marine", *marine_sizes), np.random.default_rng(2)
    for derivation in Uniform(Language(grammar), derivations=True).draw(rng, 300):
        grammar.derive(derivation)


def test_numbers_too_large_for_the_machine_are_drawn_evenly():
    total = 3 * 2**70
    ranks = draw_ranks(np.random.default_rng(1), total, 9_000)
    assert all(0 <= rank < total for rank in ranks)
    thirds = np.bincount([rank // 2**70 for rank in ranks], minlength=3)
    assert chi_squared_is_plausible(thirds, 3_000)


def test_languages_larger_than_a_machine_word_are_drawn_from(bound, marine_sizes):
    grammar = bound("general", *marine_sizes)
    uniform = Uniform(Language(grammar))
    assert uniform.total > 2**64
    for word in uniform.draw(np.random.default_rng(0), 50):
        assert sum(symbol in grammar.node_terminals for symbol in word) <= 20


def test_a_random_walk_is_the_same_for_the_same_generator_whatever_was_walked_before(bound, marine_sizes):
    fresh, used = bound("scheide", *marine_sizes), bound("scheide", *marine_sizes)
    for seed in range(50):
        used.sample(np.random.default_rng(seed))
    walks = [[grammar.sample(np.random.default_rng(7)) for _ in range(3)] for grammar in (fresh, used)]
    assert walks[0] == walks[1]


@pytest.mark.parametrize("likely", ["words", "derivations", "choices"])
def test_every_way_of_sampling_gives_words_of_the_language(bound, likely):
    grammar = bound("scheide", (1, 2), (1, 1))
    words = {word for _, word in grammar.enumerate()}
    assert set(sampler(grammar, likely)(np.random.default_rng(0), 500)) == words


@pytest.mark.parametrize("likely", ["words", "derivations", "choices"])
def test_the_command_prints_a_tree_a_line_the_same_for_the_same_seed(capsys, likely):
    command = ["grammar", "sample", "marine", "--domain", "marine", "-n", "5", "--uniform", likely, "--seed"]
    printed = []
    for seed in ("1", "1", "2"):
        assert main([*command, seed]) == 0
        printed.append(capsys.readouterr().out)
    assert printed[0] == printed[1] != printed[2]
    assert [format_tree(parse(line)) for line in printed[0].splitlines()] == printed[0].splitlines()
    assert len(printed[0].splitlines()) == 5
