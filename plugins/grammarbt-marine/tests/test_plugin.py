"""What the plugin announces, how light that is, and what its parameters refuse."""

import subprocess
import sys
from importlib.resources import files

import attrs
import pytest

from grammarbt.bt import Action, leaves, parse
from grammarbt.errors import ParameterError
from grammarbt.grammar import Source, bind, load_grammar, parse_tree
from grammarbt.plugins.parameters import build
from grammarbt_marine import hooks
from grammarbt_marine.domain import Marine
from grammarbt_marine.kernel.leaves import IN_COMMS
from grammarbt_marine.parameters import MarineParameters
from grammarbt_marine.presets import PRESETS
from grammarbt_marine.program import LEAVES
from grammarbt_marine.references import EXTENDED_REFERENCES, REFERENCES
from grammarbt_marine.vocabulary import EXTENDED_VOCABULARY, VOCABULARY


def test_announcing_the_components_imports_neither_numpy_nor_numba():
    code = "import sys, grammarbt_marine.hooks; print(sorted({'numpy', 'numba'} & set(sys.modules)))"
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert printed.strip() == "[]"


def test_the_grammar_spans_the_reference_trees_of_every_preset():
    (spec,) = hooks.grammarbt_grammars()
    grammar = load_grammar(Source(spec.name, files(spec.package).joinpath(spec.resource).read_text(encoding="utf-8")))
    for preset in PRESETS:
        marine = Marine(MarineParameters(preset))
        bound = bind(grammar, marine.vocabulary)
        assert all(parse_tree(bound, parse(reference.tree)) for reference in marine.references)


def test_the_reference_trees_use_leaves_of_the_vocabulary_and_the_first_those_that_matter():
    assert [reference.name for reference in Marine().references] == ["manual", "best order", "thorough"]
    for references, vocabulary in ((REFERENCES, VOCABULARY), (EXTENDED_REFERENCES, EXTENDED_VOCABULARY)):
        for reference in references:
            assert set(leaves(parse(reference.tree))) <= set(vocabulary.leaves)
    assert {"resurface", "coverage", "battery low"} <= {leaf.name for leaf in leaves(parse(references[0].tree))}


def test_the_simulator_knows_every_leaf_of_the_vocabulary_and_no_other():
    assert sorted(LEAVES) == sorted(leaf.name for leaf in EXTENDED_VOCABULARY.leaves)
    assert all(isinstance(leaf, Action) == (LEAVES.index(leaf.name) < IN_COMMS) for leaf in EXTENDED_VOCABULARY.leaves)


def test_every_parameter_and_every_leaf_has_help():
    assert all(field.metadata["help"] for field in attrs.fields(MarineParameters))
    assert all(kind.help for kind in EXTENDED_VOCABULARY.types.values())


def test_a_preset_gives_defaults_and_what_is_said_wins():
    fields = {field.name for field in attrs.fields(MarineParameters)}
    for preset, settings in PRESETS.items():
        parameters = MarineParameters(preset)
        assert settings.keys() <= fields
        assert {name: getattr(parameters, name) for name in settings} == settings
        said = MarineParameters(preset, targets=1, speed=0.3)
        assert (said.preset, said.targets, said.speed, said.mines) == (preset, 1, 0.3, parameters.mines)


def test_settings_of_the_command_line_reach_the_preset():
    settings = {"preset": "scheide", "horizon": "50", "battery_dead": "0.7"}
    parameters = build(MarineParameters, settings, "domain")
    assert parameters == MarineParameters("scheide", horizon=50, battery_dead=0.7)
    with pytest.raises(ParameterError, match="sparse"):
        build(MarineParameters, {"preset": "spars"}, "domain")


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
        {"robots": 0},
        {"preset": "dense"},
        {"layout": "depths", "vertices": 31},
        {"sensor": "eye"},
        {"thing_share": 1.0},
        {"battery_low": -1.0},
    ],
    ids=str,
)
def test_numbers_out_of_range_are_refused(wrong):
    with pytest.raises((ValueError, TypeError), match=list(wrong)[-1]):
        MarineParameters(**wrong)
