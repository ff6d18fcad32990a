"""Whatever stands in a grammar file, the outcome is a grammar or a diagnosis, and soon."""

import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from time import process_time

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grammarbt.bt import format_tree, parse
from grammarbt.grammar import GrammarFileError, Source, bind, load_grammar, shipped_grammars
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


def test_a_derivation_may_have_five_hundred_nodes():
    text = '%declare ACTION\nstart: "→" "(" ACTION~500 ")"\n'
    wide = diagnose(text)
    tree = wide.tree(wide.derive(wide.sample(np.random.default_rng(0))))
    assert len(tree.children) == 500
    assert parse(format_tree(tree)) == tree


def test_derivations_of_five_hundred_steps_into_the_depth_do_not_overflow_the_stack():
    deep = diagnose('%declare ACTION\nstart: "→" "(" ACTION start ")" | ACTION\n')
    deeper, (leaf, *_) = (
        (move.production for move in deep.leftmost.moves(deep.start())),
        deep.by_lhs[next(symbol for symbol in deep.by_lhs if deep.nonterminal_name(symbol) == "ACTION")],
    )
    grow, stop = deeper
    derivation = (grow, leaf.number) * 250 + (stop, leaf.number)
    form = deep.derive(derivation)
    assert deep.text(form).count("[") == 251
