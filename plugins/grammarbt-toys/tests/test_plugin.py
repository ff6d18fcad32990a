"""What the plugin announces, how light that is, and what its parameters refuse."""

import subprocess
import sys
from importlib import import_module
from importlib.resources import files

import attrs
import numpy as np
import pytest

from grammarbt.bt import compile_policy, leaves, parse
from grammarbt.grammar import Source, bind, load_grammar, shipped_grammars
from grammarbt_toys import hooks
from grammarbt_toys.parameters import AntParameters, ForagingParameters, PlatformerParameters, TaskSelectionParameters


def thing_at(path):
    module, _, name = path.partition(":")
    return getattr(import_module(module), name)


SPECS = hooks.grammarbt_domains()
SOURCES = shipped_grammars() | {
    spec.name: Source(spec.name, files(spec.package).joinpath(spec.resource).read_text(encoding="utf-8"))
    for spec in hooks.grammarbt_grammars()
}
each_domain = pytest.mark.parametrize(
    "domain", [thing_at(spec.factory)() for spec in SPECS], ids=lambda domain: type(domain).__name__
)


def returns_of(domain, tree, scenarios):
    return domain.simulate(compile_policy(tree, domain.vocabulary.index), scenarios).returns


def test_announcing_the_components_imports_neither_numpy_nor_numba():
    code = "import sys, grammarbt_toys.hooks; print(sorted({'numpy', 'numba'} & set(sys.modules)))"
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert printed.strip() == "[]"


@each_domain
def test_the_default_grammar_spans_trees_that_the_domain_understands(domain):
    bound = bind(load_grammar(SOURCES[domain.grammar]), domain.vocabulary)
    rng = np.random.default_rng(5)
    trees = [bound.tree(bound.derive(bound.sample(rng))) for _ in range(50)]
    assert all(returns_of(domain, tree, np.arange(2)).shape == (2,) for tree in trees)


@each_domain
def test_the_reference_trees_use_leaves_of_the_vocabulary(domain):
    assert domain.references
    for reference in domain.references:
        assert set(leaves(parse(reference.tree))) <= set(domain.vocabulary.leaves)


@each_domain
def test_no_scenarios_give_no_returns(domain):
    assert returns_of(domain, parse(domain.references[0].tree), np.arange(0)).shape == (0,)


@pytest.mark.parametrize("spec", SPECS, ids=lambda spec: spec.name)
def test_another_process_gives_the_same_returns_in_any_batch(spec):
    code = f"""
import numpy as np
from grammarbt.bt import compile_policy, parse
from {spec.factory.partition(":")[0]} import {spec.factory.partition(":")[2]} as Toy
toy = Toy()
policy = compile_policy(parse(toy.references[0].tree), toy.vocabulary.index)
print([toy.simulate(policy, np.array([scenario])).returns[0].item() for scenario in range(20)])
"""
    printed = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    domain = thing_at(spec.factory)()
    assert printed.strip() == str(returns_of(domain, parse(domain.references[0].tree), np.arange(20)).tolist())


@pytest.mark.parametrize("spec", SPECS, ids=lambda spec: spec.name)
def test_every_parameter_and_every_leaf_has_help(spec):
    assert all(field.metadata["help"] for field in attrs.fields(thing_at(spec.parameters)))
    assert all(kind.help for kind in thing_at(spec.factory)().vocabulary.types.values())


@pytest.mark.parametrize(
    ("parameters", "wrong"),
    [
        (TaskSelectionParameters, {"conditions": 0}),
        (TaskSelectionParameters, {"conditions": 9}),
        (TaskSelectionParameters, {"conditions": 3.0}),
        (AntParameters, {"steps": 0}),
        (AntParameters, {"steps": "many"}),
        (ForagingParameters, {"size": 7}),
        (ForagingParameters, {"robots": 0}),
        (ForagingParameters, {"sight": -1}),
        (PlatformerParameters, {"columns": 1}),
        (PlatformerParameters, {"steps": 0}),
    ],
    ids=str,
)
def test_numbers_out_of_range_are_refused(parameters, wrong):
    with pytest.raises((ValueError, TypeError), match=next(iter(wrong))):
        parameters(**wrong)
