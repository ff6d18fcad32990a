"""What the plugin announces, how light that is, and what its parameters refuse."""

import subprocess
import sys
from importlib.resources import files

import attrs
import pytest

from grammarbt.bt import Action, leaves, parse
from grammarbt.grammar import Source, bind, load_grammar
from grammarbt_marine import hooks
from grammarbt_marine.domain import Marine
from grammarbt_marine.kernel import IN_COMMS, LEAVES
from grammarbt_marine.parameters import MarineParameters
from grammarbt_marine.vocabulary import VOCABULARY


def test_announcing_the_components_imports_neither_numpy_nor_numba():
    code = "import sys, grammarbt_marine.hooks; print(sorted({'numpy', 'numba'} & set(sys.modules)))"
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert printed.strip() == "[]"


def test_the_grammar_binds_to_the_vocabulary():
    (spec,) = hooks.grammarbt_grammars()
    text = files(spec.package).joinpath(spec.resource).read_text(encoding="utf-8")
    assert bind(load_grammar(Source(spec.name, text)), VOCABULARY).start()


def test_the_reference_trees_use_leaves_of_the_vocabulary():
    assert [reference.name for reference in Marine.references] == ["manual", "best order"]
    for reference in Marine.references:
        assert set(leaves(parse(reference.tree))) <= set(VOCABULARY.leaves)


def test_the_simulator_knows_every_leaf_of_the_vocabulary_and_no_other():
    assert sorted(LEAVES) == sorted(leaf.name for leaf in VOCABULARY.leaves)
    assert all(isinstance(leaf, Action) == (LEAVES.index(leaf.name) < IN_COMMS) for leaf in VOCABULARY.leaves)


def test_every_parameter_and_every_leaf_has_help():
    assert all(field.metadata["help"] for field in attrs.fields(MarineParameters))
    assert all(kind.help for kind in VOCABULARY.types.values())


@pytest.mark.parametrize(
    "wrong",
    [
        {"vertices": 2},
        {"vertices": 22},
        {"vertices": 80.0},
        {"targets": -1},
        {"target_pd": 1.0},
        {"mine_pf": 0.0},
        {"target_found": float("nan")},
        {"horizon": 0},
        {"surface_share": 1.5},
        {"object_reward": float("inf")},
    ],
    ids=str,
)
def test_numbers_out_of_range_are_refused(wrong):
    with pytest.raises((ValueError, TypeError), match=next(iter(wrong))):
        MarineParameters(**wrong)
