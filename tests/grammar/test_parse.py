"""Reading trees back: the derivation of what is in the language, the place where everything else leaves it."""

import json
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.bt import Action, Condition, Fallback, Sequence, format_tree, parse
from grammarbt.bt.vocabulary import ActionType, ConditionType, Group, Vocabulary
from grammarbt.cli import main
from grammarbt.errors import GrammarError
from grammarbt.grammar import Source, bind, load_grammar, shipped_grammars
from grammarbt.grammar.parse import NotInLanguageError, parse_tree, row_text, tree_tokens
from grammarbt.testing import trees_over

NESTED = '%declare ACTION\nstart: tree\ntree: "?" "(" tree+ ")" | "→" "(" tree tree+ ")" | ACTION\n'


def tree_of(bound, seed):
    return bound.tree(bound.derive(bound.sample(np.random.default_rng(seed))))


@pytest.fixture(scope="module")
def languages():
    groups = tuple(
        Group(
            f"g{at}", (ActionType(f"a{at}"), ActionType(f"b{at}")), (ConditionType(f"c{at}"), ConditionType(f"d{at}"))
        )
        for at in range(3)
    )
    shipped = shipped_grammars()
    return {name: bind(load_grammar(shipped[name]), Vocabulary(groups)) for name in ("scheide", "marine", "general")}


@settings(max_examples=150, deadline=None)
@given(name=st.sampled_from(["scheide", "marine", "general"]), seed=st.integers(0, 2**32))
def test_a_sampled_tree_is_read_back_to_a_derivation_of_the_same_tree(languages, name, seed):
    bound = languages[name]
    tree = tree_of(bound, seed)
    assert bound.tree(bound.derive(parse_tree(bound, tree))) == tree


def test_every_word_of_a_small_language_gets_its_first_derivation(bound):
    grammar = bound("scheide", (2, 2), (1, 1))
    first = {}
    for derivation, word in grammar.enumerate():
        first.setdefault(word, derivation)
    for word, derivation in first.items():
        assert parse_tree(grammar, grammar.tree_of(word)) == derivation


LEAF = st.sampled_from([Action("a1.0"), Action("a2.0"), Action("alien"), Condition("c1.0"), Condition("c2.0")])
TREE = trees_over(LEAF, most=8)


@pytest.mark.parametrize("name", ["scheide", "marine"])
def test_membership_equals_enumeration_for_any_tree(bound, name):
    grammar = bound(name, (1, 1), (1, 1))
    words = {grammar.tree_of(word) for _, word in grammar.enumerate()}

    @settings(max_examples=300, deadline=None)
    @given(tree=st.one_of(TREE, st.sampled_from(sorted(words, key=format_tree))))
    def check(tree):
        if tree in words:
            assert grammar.tree(grammar.derive(parse_tree(grammar, tree))) == tree
        else:
            with pytest.raises(NotInLanguageError) as caught:
                parse_tree(grammar, tree)
            assert_place_is_true(grammar, words, caught.value)

    check()


def assert_place_is_true(grammar, words, error):
    """Some word goes on from there with each of the alternatives, and none with what the tree has."""
    texts = grammar.token_texts
    rows = [tuple(texts[symbol] for symbol in word) for word in map(numbered(grammar), words)]
    before = tuple(map(text_of, error.row[: error.place]))
    following = {row[error.place] for row in rows if row[: error.place] == before and len(row) > error.place}
    assert following == set(error.possible)
    assert error.found not in following
    assert error.closest in following


def numbered(grammar):
    number = {token: at for at, token in enumerate(grammar.terminals)}
    return lambda tree: [number[token] for token in tree_tokens(tree)]


def text_of(token):
    return row_text((token,))


def test_the_message_says_where_and_what_would_be_possible(bound):
    grammar = bound("marine", (1, 1), (1, 1))
    with pytest.raises(NotInLanguageError) as caught:
        parse_tree(grammar, parse("?( →( (c1.0) [a1.0] ) →( (c2.0) [a1.0] ) )"))
    assert caught.value.found == "[a1.0]"
    assert caught.value.before == "?( →( (c1.0) [a1.0] ) →( (c2.0)"
    assert caught.value.closest == "[a2.0]"


def test_a_missing_child_is_found_where_the_tree_closes(bound):
    grammar = bound("marine", (1, 1), (1, 1))
    with pytest.raises(NotInLanguageError) as caught:
        parse_tree(grammar, parse("?( →( (c1.0) [a1.0] ) )"))
    assert caught.value.found == ")"
    assert caught.value.possible == ("→",)


def test_a_block_is_read_on_its_own(bound):
    grammar = bound("scheide", (2, 3), (1, 1))
    block = grammar.blocks[0]
    for derivation, word in list(grammar.enumerate(block))[::50]:
        found = parse_tree(grammar, grammar.tree_of(word), block)
        assert grammar.derive(found, block) == grammar.derive(derivation, block)


@pytest.mark.parametrize("shape", ["wide", "deep", "both"])
def test_trees_of_five_hundred_nodes_are_read_within_seconds(vocabulary, shape):
    grammar = bind(load_grammar(Source("nested.grammar", NESTED)), vocabulary((3, 0)))
    leaf = Action("a1.0")
    tree = {"wide": Fallback((leaf,) * 500), "deep": leaf, "both": leaf}[shape]
    for _ in range({"wide": 0, "deep": 250, "both": 125}[shape]):
        tree = Sequence((leaf, tree)) if shape == "deep" else Sequence((leaf, tree, leaf, leaf))
    began = time.perf_counter()
    derivation = parse_tree(grammar, tree)
    assert time.perf_counter() - began < 5
    assert grammar.tree(grammar.derive(derivation)) == tree


def test_a_hopelessly_ambiguous_tree_is_an_error_and_not_a_stall(vocabulary, monkeypatch):
    monkeypatch.setattr("grammarbt.grammar.parse.MAX_STEPS", 100)
    text = '%declare ACTION\nstart: "?" "(" t+ ")"\nt: u u | v v | ACTION\nu: t\nv: t "[a1.0]" | t\n'
    grammar = bind(load_grammar(Source("a.grammar", text)), vocabulary((1, 0)))
    with pytest.raises(GrammarError, match="100 steps"):
        parse_tree(grammar, Fallback((*[Action("a1.0")] * 40, Action("alien"))))


IN = "?( →( (mine found) [disarm] ) →( [random walk] ) )"
OUT = "?( →( (mine found) [disarm] ) [random walk] )"


def test_the_command_prints_the_derivation_of_a_tree_of_the_language(capsys):
    assert main(["grammar", "parse", "marine", IN, "--domain", "marine", "--json"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["member"]
    assert result["derivation"][0]["text"].startswith("start ⇒ ?")
    assert main(["grammar", "parse", "marine", IN, "--domain", "marine"]) == 0
    assert capsys.readouterr().out.splitlines() == [step["text"] for step in result["derivation"]]


def test_the_command_points_at_the_place_where_a_tree_leaves_the_language(capsys):
    assert main(["grammar", "parse", "marine", OUT, "--domain", "marine"]) == 1
    line, marks, *_ = capsys.readouterr().out.splitlines()
    assert line[marks.index("^") :] == "[random walk]"
    assert main(["grammar", "parse", "marine", OUT, "--domain", "marine", "--json"]) == 1
    result = json.loads(capsys.readouterr().out)
    assert (result["member"], result["found"], result["closest"]) == (False, "[random walk]", "→")


def test_a_text_that_is_no_tree_is_a_mistake(capsys):
    assert main(["grammar", "parse", "marine", "?( [a", "--domain", "marine"]) == 2
    assert "column" in capsys.readouterr().err
