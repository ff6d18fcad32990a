"""Whatever stands in a grammar file, the outcome is a grammar or a diagnosis, and soon."""

import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from time import process_time

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grammarbt.bt import format_tree, parse, walk
from grammarbt.errors import GrammarError
from grammarbt.grammar import GrammarFileError, Source, bind, load_grammar, parse_tree, shipped_grammars
from grammarbt.grammar.check import check_source


def load(name):
    """A module of `benchmarks/`, which is no package."""
    spec = spec_from_file_location(name, Path(__file__).parents[2] / "benchmarks" / f"{name}.py")
    module = sys.modules[name] = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


hostile = load("hostile")
SHIPPED = sorted(source.text for source in shipped_grammars().values())
SECONDS = 1.0


def diagnose(text):
    """Bind a text; if that fails, the finding must have a place unless it concerns the whole grammar."""
    begin = process_time()
    try:
        bound = bind(load_grammar(Source("x.grammar", text)), hostile.VOCABULARY)
    except GrammarFileError as error:
        for finding in error.diagnostics:
            assert finding.span is not None or finding.code in {"G102", "G404"}
            assert finding.code in finding.render()
        bound = None
    assert process_time() - begin < SECONDS
    return bound


@st.composite
def mutations(draw):
    text = draw(st.sampled_from(SHIPPED))
    for _ in range(draw(st.integers(1, 4))):
        one, length, other = (draw(st.integers(0, most)) for most in (len(text), 40, len(text)))
        chunk = text[one : one + length]
        cut = text[:one] + text[one + length :]
        text = draw(
            st.sampled_from(
                (cut, text[:other] + chunk + text[other:], cut[:other] + chunk + cut[other:], text[:one] + text[other:])
            )
        )
    return text


@given(st.lists(st.sampled_from(hostile.PIECES), max_size=60).map("".join))
@settings(max_examples=400, deadline=None)
def test_random_texts_of_the_language_end_in_a_grammar_or_a_diagnosis(text):
    diagnose(text)


@given(st.text(max_size=200))
@settings(max_examples=200, deadline=None)
def test_any_text_ends_in_a_grammar_or_a_diagnosis(text):
    diagnose(text)


@given(mutations())
@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_what_mutated_grammars_derive_are_trees(text):
    grammar = diagnose(text)
    if grammar is not None:
        rng = np.random.default_rng(0)
        for _ in range(3):
            derivation, state, steps = [], grammar.start(), 0
            while (moves := grammar.leftmost.moves(state)) and steps < 300:
                move = moves[rng.integers(len(moves))]
                derivation, state, steps = [*derivation, move.production], move.after, steps + 1
            if not moves and not state.symbols:
                tree = grammar.tree(grammar.derive(tuple(derivation)))
                assert parse(format_tree(tree)) == tree
            assert moves or not state.symbols


@pytest.mark.parametrize(("name", "text"), [pytest.param(*case, id=case[0]) for case in hostile.explosive()])
def test_explosive_text_ends_within_a_second(name, text):
    assert name
    diagnose(text)


@pytest.mark.parametrize(("name", "text"), [pytest.param(*case, id=case[0]) for case in hostile.explosive()])
def test_checking_an_explosive_text_ends_soon(name, text):
    assert name
    begin = process_time()
    report = check_source(Source("x.grammar", text), hostile.VOCABULARY)
    assert report.findings or report.summary
    assert process_time() - begin < 5 * SECONDS


@pytest.mark.parametrize("rule", ['start: "?"', 'start: sign\nsign: "→" | "!"\n', 'start: "!" | "→"'])
def test_an_operator_alone_is_no_tree(rule):
    report = check_source(Source("x.grammar", f"{rule}\n"), hostile.VOCABULARY)
    assert {finding.code for finding in report.errors} == {"G303"}


ENDLESS = '%declare ACTION\nstart: "?" "(" start start start ")" | ACTION\n'


def test_a_random_tree_that_grows_without_end_is_an_error_that_says_what_to_do():
    grammar = diagnose(ENDLESS)
    error = next(filter(None, (outcome_of(grammar, seed) for seed in range(20))))
    assert error.startswith("x.grammar: a random tree passes")
    assert "%limit nodes" in error


def outcome_of(grammar, seed):
    """The error of a random derivation, if there is one."""
    try:
        grammar.sample(np.random.default_rng(seed))
    except GrammarError as error:
        return str(error)
    return ""


def test_forgetting_states_to_bound_the_memory_changes_no_derivation(monkeypatch):
    monkeypatch.setattr("grammarbt.grammar.leftmost.MAX_KEPT", 2_000)
    monkeypatch.setattr("grammarbt.grammar.completion.MAX_KEPT", 2_000)
    grammar = diagnose(ENDLESS + "%limit nodes 200\n")
    fresh = diagnose(ENDLESS + "%limit nodes 200\n")
    for seed in range(5):
        derivation = grammar.sample(np.random.default_rng(seed))
        assert fresh.derive(derivation) == grammar.derive(derivation)


def test_constraints_too_entangled_to_derive_from_are_shown_at_their_place(monkeypatch):
    text = '%declare ACTION CONDITION\n%unique ACTION CONDITION in start\nstart: "?" "(" leaf~4 ")"\nleaf: ACTION | CONDITION\n'
    grammar = diagnose(text)
    monkeypatch.setattr("grammarbt.grammar.needs.MAX_STEPS", 0)
    with pytest.raises(GrammarFileError) as caught:
        grammar.sample(np.random.default_rng(0))
    (finding,) = caught.value.diagnostics
    assert (finding.code, finding.place) == ("G406", "x.grammar:2:1")
    assert finding.notes[0].startswith("to be finished: ")
    assert finding.help


SHAPES = {
    "wide": 'start: "→" "(" ACTION~500 ")"',
    "deep": '%limit depth 256\nstart: "→" "(" ACTION start ")" @ 1000000 | ACTION',
    "deep with other limits": "%limit nodes 520\n%limit depth 256\n%unique CONDITION in start\n"
    'start: "→" "(" ACTION start ")" @ 1000000 | "→" "(" CONDITION ACTION ")"',
    "both": '%limit depth 200\nstart: "?" "(" "!" "(" start ")" ACTION~4 ")" @ 1000000 | ACTION',
}


@pytest.mark.parametrize("shape", SHAPES)
def test_trees_of_five_hundred_nodes_are_sampled_derived_built_printed_and_parsed(shape):
    grammar = diagnose(f"%declare ACTION CONDITION\n{SHAPES[shape]}\n")
    derivation = grammar.sample(np.random.default_rng(0))
    tree = grammar.tree(grammar.derive(derivation))
    assert sum(1 for _ in walk(tree)) >= 500
    assert parse(format_tree(tree)) == tree
    assert grammar.derive(parse_tree(grammar, tree)) == grammar.derive(derivation)


def test_a_tree_deeper_than_trees_can_be_is_an_error_and_no_overflow():
    grammar = diagnose('%declare ACTION\nstart: "→" "(" ACTION start ")" @ 1000000 | ACTION\n%limit nodes 600\n')
    form = grammar.derive(grammar.sample(np.random.default_rng(0)))
    assert grammar.text(form).count("[") > 256
    with pytest.raises(GrammarError, match="deeper than 256 levels") as caught:
        grammar.tree(form)
    assert caught.value.hint.startswith("add `%limit depth 256`")
