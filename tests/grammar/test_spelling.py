"""Forms spelled as texts are the same forms, and the same is legal in them."""

import numpy as np
import pytest

from grammarbt.grammar import Pieces, Source, Spelling, bind, load_grammar

SIZES = ((2, 3), (1, 2), (1, 1))
NAMES = ["scheide", "marine", "general", "sized", "perez", "ppa"]


def forms(grammar, rng, derivations):
    """Forms of random derivations in any order, each with the step that leads on."""
    for _ in range(derivations):
        form = grammar.start()
        while not grammar.is_word(form) and len(form.symbols) < 60:
            position = int(rng.choice(grammar.positions(form)))
            production = int(rng.choice(grammar.legal(form, position)))
            yield form, position, production
            form = grammar.apply(form, production, position)


def every_form(grammar):
    """All forms that the start symbol leads to."""
    seen, queue = {grammar.start(): None}, [grammar.start()]
    for form in queue:
        for position in grammar.positions(form):
            after = [grammar.apply(form, number, position) for number in grammar.legal(form, position)]
            new = dict.fromkeys(form for form in after if form not in seen)
            seen.update(new)
            queue.extend(new)
    return seen


@pytest.mark.parametrize("name", NAMES)
def test_a_text_spells_one_form(bound, name):
    grammar = bound(name, *SIZES)
    spelling = Spelling(grammar)
    met = {spelling.text(form): form for form, _, _ in forms(grammar, np.random.default_rng(0), 20)}
    assert len(set(met.values())) == len(met)
    assert all(spelling.form(text) == form for text, form in met.items())
    assert all(spelling.positions(text) == list(grammar.positions(form)) for text, form in met.items())


@pytest.mark.parametrize("name", NAMES)
def test_a_production_does_the_same_to_a_form_and_to_its_text(bound, name):
    grammar = bound(name, *SIZES)
    spelling = Spelling(grammar)
    for form, position, production in forms(grammar, np.random.default_rng(1), 20):
        after = spelling.applied(spelling.text(form), production, position)
        assert after is not None
        assert spelling.form(after) == grammar.apply(form, production, position)


@pytest.mark.parametrize("name", NAMES)
def test_options_are_what_is_legal_at_each_nonterminal(bound, name):
    grammar = bound(name, *SIZES)
    spelling = Spelling(grammar)
    pieces = Pieces(spelling)
    for form, _, _ in forms(grammar, np.random.default_rng(2), 8):
        places = enumerate(grammar.positions(form))
        expected = [(place, number) for place, at in places for number in grammar.legal(form, at)]
        assert pieces.options(spelling.text(form)) == expected


@pytest.mark.parametrize("name", NAMES)
def test_parents_have_the_form_by_their_production(bound, name):
    grammar = bound(name, *SIZES)
    spelling = Spelling(grammar)
    for form, _, _ in forms(grammar, np.random.default_rng(3), 8):
        found = [(spelling.form(above), number) for above, number, _ in spelling.parents(spelling.text(form))]
        everything = grammar.parents(form)
        assert [parent for parent in everything if parent in found] == found


VANISHING = """%declare ACTION CONDITION
%unique ACTION CONDITION in start
start: "→" "(" CONDITION* guard? ACTION tail ")"
guard: "!" "(" CONDITION ")"
tail: ACTION? CONDITION*
"""


@pytest.fixture
def small_language(bound, vocabulary):
    """A shipped grammar for two groups, or one whose parts may be left out."""

    def make(name):
        if name == "vanishing":
            return bind(load_grammar(Source("vanishing.grammar", VANISHING)), vocabulary((1, 1), (1, 1)))
        return bound(name, (1, 2), (1, 1))

    return make


@pytest.mark.parametrize("name", ["scheide", "marine", "vanishing"])
def test_no_parent_that_the_start_symbol_leads_to_is_missed(small_language, name):
    grammar = small_language(name)
    spelling, seen = Spelling(grammar), every_form(grammar)
    assert len(seen) > 500
    left_out = 0
    for form in seen:
        found = {spelling.form(above): at for above, _, at in spelling.parents(spelling.text(form))}
        everything = {parent for parent, _ in grammar.parents(form)}
        assert {parent for parent in everything if parent in seen} <= found.keys() <= everything
        left_out += len(everything) - len(found)
    assert left_out > 0


def test_the_pieces_of_a_form_are_its_scopes_and_what_is_around_them(bound):
    grammar = bound("scheide", (2, 2), (2, 2))
    spelling, form = Spelling(grammar), grammar.start()
    for name in ("start", "each", "subtree{g1}", "each+", "each", "subtree{g2}"):
        at = next(at for at in grammar.positions(form) if grammar.symbol_text(form.symbols[at]) == name)
        form = grammar.apply(form, grammar.legal(form, at)[0 if name != "each+" else -1], at)
    found = Pieces(spelling).split(spelling.text(form))
    assert [spelling.symbol(piece.text[0]) for piece in found] == [grammar.opening(block) for block in grammar.blocks]
    assert [place for piece in found for place in piece.places] == list(range(len(grammar.positions(form))))


def test_where_everything_counts_for_the_whole_tree_a_form_is_one_piece(bound):
    grammar = bound("sized", *SIZES)
    spelling = Spelling(grammar)
    pieces = Pieces(spelling)
    for form, _, _ in forms(grammar, np.random.default_rng(4), 5):
        assert len(pieces.split(spelling.text(form))) == 1


@pytest.mark.parametrize("limit", ["", "%limit depth 2\n"])
def test_a_language_without_parentheses_has_options(vocabulary, limit):
    text = f"%declare ACTION CONDITION\n%unique ACTION in start\n{limit}start: part\npart: ACTION | CONDITION\n"
    grammar = bind(load_grammar(Source("leaf.grammar", text)), vocabulary((2, 1)))
    spelling = Spelling(grammar)
    pieces, form = Pieces(spelling), grammar.start()
    while not grammar.is_word(form):
        (position,) = grammar.positions(form)
        assert pieces.options(spelling.text(form)) == [(0, number) for number in grammar.legal(form, position)]
        form = grammar.apply(form, grammar.legal(form)[0])


@pytest.mark.parametrize("name", ["scheide", "marine"])
def test_forms_fall_into_few_pieces(bound, name):
    grammar = bound(name, *SIZES)
    spelling = Spelling(grammar)
    pieces = Pieces(spelling)
    met = {spelling.text(form) for form, _, _ in forms(grammar, np.random.default_rng(5), 200)}
    found = {piece.text for text in met for piece in pieces.split(text)}
    assert len(found) < len(met) / 4
