"""A genome stands for one derivation, and a derivation has genomes that stand for it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import bind, load_grammar, shipped_grammars
from grammarbt.search import States
from grammarbt_ge.initialise import Initialiser
from grammarbt_ge.mapping import CODONS, Mapper

VOCABULARY = Vocabulary(
    (
        Group("g1", (ActionType("a"), ActionType("b")), (ConditionType("c"), ConditionType("d"))),
        Group("g2", (ActionType("e"),), (ConditionType("f"),)),
    )
)
MAPPINGS = ("linear", "structured")
quick = settings(deadline=None, max_examples=25)  # what a grammar's first states cost is not what is tested


@pytest.fixture(scope="module")
def grammars():
    return {name: bind(load_grammar(source), VOCABULARY) for name, source in shipped_grammars().items()}


@pytest.fixture(scope="module")
def mappers(grammars):
    tables = {name: States(grammar) for name, grammar in grammars.items()}
    return {(name, mapping): Mapper(tables[name], mapping, 2) for name in tables for mapping in MAPPINGS}


def drawn(data, mappers):
    return mappers[data.draw(st.sampled_from(sorted(mappers)))]


@quick
@given(data=st.data(), seed=st.integers(0, 2**32))
def test_the_genome_of_a_derivation_maps_back_to_it(mappers, data, seed):
    mapper, rng = drawn(data, mappers), np.random.default_rng(seed)
    derivation = mapper.states.grammar.sample(rng)
    assert mapper.derivation(mapper.genome(derivation, rng)) == derivation


@quick
@given(data=st.data(), length=st.integers(0, 40), seed=st.integers(0, 2**32))
def test_every_genome_has_a_tree_of_the_language(mappers, data, length, seed):
    mapper, rng = drawn(data, mappers), np.random.default_rng(seed)
    genome = tuple(tuple(rng.integers(CODONS, size=length).tolist()) for _ in range(mapper.lists))
    derivation = mapper.derivation(genome)
    mapper.states.grammar.derive(derivation)
    assert mapper.derivation(genome) == derivation


@quick
@given(data=st.data(), seed=st.integers(0, 2**32))
def test_codons_that_make_the_same_choices_map_to_the_same_derivation(mappers, data, seed):
    mapper, rng = drawn(data, mappers), np.random.default_rng(seed)
    derivation = mapper.states.grammar.sample(rng)
    first, second = (mapper.genome(derivation, rng) for _ in range(2))
    assert mapper.derivation(first) == mapper.derivation(second)
    assert all(0 <= codon < CODONS for codons in first for codon in codons)


@quick
@given(data=st.data(), length=st.integers(1, 40), seed=st.integers(0, 2**32))
def test_the_codons_read_are_as_many_as_there_were_choices_and_say_which_step_they_chose(mappers, data, length, seed):
    mapper, rng = drawn(data, mappers), np.random.default_rng(seed)
    genome = tuple(tuple(rng.integers(CODONS, size=length).tolist()) for _ in range(mapper.lists))
    reading, walk = mapper.read(genome), mapper.states.walk()
    choices = {}
    for step, production in enumerate(reading.derivation):
        if len(walk.state.productions) > 1:
            choices[step] = walk.state.productions.index(production), len(walk.state.productions)
        walk.take(production)
    assert [step for step, *_ in reading.codons] == list(choices)
    assert all(codon % choices[step][1] == choices[step][0] for step, _, codon in reading.codons)


def test_a_list_that_is_at_its_end_is_read_again(grammars):
    states = States(grammars["scheide"])
    rng = np.random.default_rng(0)
    whole = Mapper(states, "linear", 0)
    codons = tuple(int(codon) for codon in rng.integers(CODONS, size=3))
    assert Mapper(states, "linear", 2).derivation((codons,)) == whole.derivation((codons * 3,))


@pytest.mark.parametrize("name", ["pi-grow", "sensible", "random"])
def test_the_first_generation_is_in_the_language_and_varied(grammars, name):
    grammar = grammars["general"]
    made = Initialiser(States(grammar), 7, np.random.default_rng(0)).derivations(name, 60)
    for derivation in made:
        grammar.derive(derivation)
    assert len(made) == 60
    assert len({*made}) > 20
    assert len({*map(len, made)}) > 5


@pytest.mark.parametrize("name", ["pi-grow", "sensible"])
def test_later_derivations_grow_deeper(grammars, name):
    made = Initialiser(States(grammars["general"]), 12, np.random.default_rng(0)).derivations(name, 80)
    sizes = [len(derivation) for derivation in made]
    assert np.mean(sizes[:20]) < np.mean(sizes[-20:])
