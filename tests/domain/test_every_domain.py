"""Every domain that the installed plugins bring says what its leaves do, can be watched, and has a recorded episode."""

import importlib.util
import os
import sys
from pathlib import Path

import attrs
import pytest

from grammarbt.bt import compile_policy, format_leaf, leaves, parse
from grammarbt.bt.vocabulary import ANY_RESULT
from grammarbt.domain import Watchable
from grammarbt.plugins import PluginHost, PluginOptions, Registry

ROOT = Path(__file__).parents[2]
GREENHOUSE = ROOT / "docs" / "examples" / "exec" / "greenhouse.py"
NEEDED = {"exec": {"command": f"{sys.executable} {GREENHOUSE}"}}
"""Parameters of domains that cannot be made without."""

HOST = PluginHost(PluginOptions.from_environment(os.environ), lambda _: None)
REGISTRY = Registry(HOST)
SPECS = {spec.name: spec for plugin in HOST.plugins for spec in plugin.provides["domains"]}
SEARCHERS = {spec.name: spec for plugin in HOST.plugins for spec in plugin.provides["searchers"]}


@pytest.fixture(scope="module", params=sorted(SPECS))
def name(request):
    return request.param


@pytest.fixture(scope="module")
def domain(name):
    made = REGISTRY.make_domain(name, NEEDED.get(name, {}))
    yield made
    getattr(made, "close", lambda: None)()


def distribution_of(spec):
    """The folder of the plugin that a component comes from."""
    source = Path(importlib.util.find_spec(spec.factory.partition(":")[0]).origin)
    return next(folder for folder in source.parents if (folder / "pyproject.toml").exists())


def recorded_episodes(folder):
    """The texts of recorded episodes beside a plugin's tests."""
    return [path.read_text(encoding="utf-8") for path in sorted(folder.glob("tests/playthroughs/*.txt"))]


def test_every_plugin_in_the_checkout_is_asked():
    announced = {path.parents[2].name for path in (ROOT / "plugins").glob("*/src/*/hooks.py")}
    loaded = {f"grammarbt-{plugin.name}" for plugin in HOST.plugins if plugin.status == "ok"}
    assert announced <= loaded


def test_each_leaf_is_explained_in_a_sentence(domain):
    assert [kind.name for kind in domain.vocabulary.types.values() if not kind.help.strip().endswith(".")] == []


def test_each_action_declares_what_it_may_answer(domain):
    for leaf, results in domain.vocabulary.results.items():
        assert results, leaf
        assert results <= ANY_RESULT, leaf


def test_each_parameter_is_explained(name):
    parameters = attrs.fields(REGISTRY.parameters_of(SPECS[name]))
    assert [field.name for field in parameters if not field.metadata.get("help")] == []


def test_there_is_a_reference_to_compare_with(domain):
    assert domain.references
    for reference in domain.references:
        assert set(leaves(parse(reference.tree))) <= set(domain.vocabulary.leaves)


def test_an_episode_can_be_watched(domain):
    assert isinstance(domain, Watchable)
    tree = parse(domain.references[0].tree)
    episode = domain.episode(compile_policy(tree, domain.vocabulary.index), 0)
    assert episode.marks or any(frame.changes for frame in episode.frames)
    assert all(frame.answers for frame in episode.frames)


def test_an_episode_is_recorded_as_text(name, domain):
    texts = recorded_episodes(distribution_of(SPECS[name]))
    names = [format_leaf(leaf) for leaf in leaves(parse(domain.references[0].tree))]
    assert any(all(leaf in text for leaf in names) for text in texts)


@pytest.mark.parametrize("spec", [*SPECS.values(), *SEARCHERS.values()], ids=lambda spec: spec.name)
def test_no_component_lacks_the_conformance_kit(spec):
    tests = "\n".join(
        path.read_text(encoding="utf-8") for path in sorted((distribution_of(spec) / "tests").rglob("*.py"))
    )
    kind = "Domain" if spec.name in SPECS else "Searcher"
    assert f"({kind}Conformance)" in tests
    assert f'{kind}Subject("{spec.name}"' in tests
