"""Children are made of what is read of their parents, and of little else."""

from itertools import product

import numpy as np
import pytest

from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt.search import DerivationTree, Moves, SearchContext, States
from grammarbt_ge.breeding import Breeder
from grammarbt_ge.mapping import Mapper
from grammarbt_ge.parameters import GeParameters
from grammarbt_ge.search import Genomes

VOCABULARY = Vocabulary((Group("g", (ActionType("a"), ActionType("b")), (ConditionType("c"), ConditionType("d"))),))
FREE = """%declare ACTION CONDITION
start: list
list: "→" "(" item item ")"
item: ACTION | "?" "(" CONDITION ACTION ")" | "?" "(" CONDITION item ")" | list
"""
MAPPINGS = pytest.mark.parametrize("mapping", ["linear", "structured"])


@pytest.fixture(scope="module")
def grammar():
    return bind(load_grammar(Source("free", FREE)), VOCABULARY)


@pytest.fixture(scope="module")
def parents(grammar):
    """Makes pairs of readings."""

    def made(mapping, n):
        mapper, rng = Mapper(States(grammar), mapping, 2), np.random.default_rng(0)
        breeder = Breeder(mapper, rng)
        drawn = [mapper.read(mapper.genome(grammar.sample(rng), rng)) for _ in range(2 * n)]
        return breeder, zip(drawn[:n], drawn[n:], strict=True)

    return made


def codons(reading, gene=None):
    return [codon for _, own, codon in reading.codons if gene in (None, own)]


def test_one_point_crossover_joins_a_head_and_a_tail(parents):
    breeder, pairs = parents("linear", 50)
    found = [joined(one, other, codons(breeder.crossed(one, other))) for one, other in pairs]
    assert sum(found) > 40  # the rest had nothing of either, and is all shortest choices


def joined(one, other, child):
    """Whether a child's codons are a head and a tail, read up to three times."""
    own, new = codons(one), codons(other)
    cuts = product(range(len(own) + 1), range(len(new) + 1))
    wholes = (own[:at] + new[place:] for at, place in cuts)
    return any(child[: 3 * len(whole)] == (3 * whole)[: len(child)] for whole in wholes if whole)


def test_structured_crossover_exchanges_whole_lists(parents):
    breeder, pairs = parents("structured", 50)
    for one, other in pairs:
        child = breeder.crossed(one, other)
        for gene in range(breeder.mapper.lists):
            read = codons(child, gene)[: min(len(codons(one, gene)), len(codons(other, gene)))]
            assert read in (codons(one, gene)[: len(read)], codons(other, gene)[: len(read)])


@MAPPINGS
def test_matched_parents_exchange_a_sub_tree_and_nothing_else_changes(grammar, parents, mapping):
    breeder, pairs = parents(mapping, 50)
    moves = Moves(grammar)
    for one, other in pairs:
        tree, giver = (moves.tree(parent.derivation) for parent in (one, other))
        assert breeder.matched(one, other).derivation in exchanged(tree, giver)


def exchanged(tree: DerivationTree, giver: DerivationTree):
    """Every tree with a sub-tree of another one in the place of one from the same nonterminal."""
    return {
        tree.replaced(at, giver.below(place))
        for at, symbol in enumerate(tree.symbols)
        for place in giver.by_symbol.get(symbol, [])
    }


@MAPPINGS
def test_a_flip_changes_one_step_and_nothing_before_it(parents, mapping):
    breeder, pairs = parents(mapping, 50)
    changed = 0
    for one, _ in pairs:
        child = breeder.flipped(one)
        differing = [at for at, (old, new) in enumerate(zip(one.codons, child.codons, strict=False)) if old != new]
        assert differing
        step = one.codons[differing[0]][0]
        assert child.derivation[:step] == one.derivation[:step]
        changed += child.derivation != one.derivation
    assert changed > 10


@MAPPINGS
def test_breeding_never_changes_what_there_is_only_one_of(mapping):
    only = bind(load_grammar(Source("only", '%declare ACTION\nstart: "→" "(" ACTION ACTION ")"')), one_action())
    mapper = Mapper(States(only), mapping, 2)
    breeder = Breeder(mapper, np.random.default_rng(0))
    one = mapper.read(((),) * mapper.lists)
    assert one.codons == ()
    assert breeder.flipped(one) is breeder.matched(one, one) is one


def one_action():
    return Vocabulary((Group("g", (ActionType("a"),), ()),))


def test_the_parameters_say_how_children_are_bred(grammar, monkeypatch):
    for way, parameters in {
        "crossed": {"crossover": 1.0, "matching": 0.0},
        "matched": {"crossover": 1.0, "matching": 1.0},
        "flipped": {"crossover": 0.0, "regrow": 0.0},
    }.items():
        context = SearchContext(grammar, VOCABULARY, np.random.default_rng(0), 1_000)
        genomes = Genomes(context, GeParameters(**parameters), States(grammar))
        one, other = genomes.stranger(), genomes.stranger()
        monkeypatch.setattr(Breeder, way, lambda *_, way=way: way)
        assert genomes.child(one, other) == way
        monkeypatch.undo()
