"""All distributions carry one version, and each plugin asks for the core and says what interface it was written for."""

import tomllib
from pathlib import Path

import pytest

import grammarbt
from grammarbt.plugins import PluginHost, PluginOptions

ROOT = Path(__file__).parents[2]
PLUGINS = sorted(path.parent for path in ROOT.glob("plugins/*/pyproject.toml"))


def project(folder):
    return tomllib.loads((folder / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_the_core_has_one_version():
    assert project(ROOT)["version"] == grammarbt.__version__
    assert f"version: {grammarbt.__version__}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"## {grammarbt.__version__}" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("folder", PLUGINS, ids=lambda path: path.name)
def test_a_plugin_is_in_step(folder):
    described = project(folder)
    name = folder.name.removeprefix("grammarbt-")
    assert described["name"] == folder.name
    assert described["version"] == grammarbt.__version__
    assert "grammarbt" in described["dependencies"]
    assert described["requires-python"] == project(ROOT)["requires-python"]
    assert described["entry-points"]["grammarbt"] == {name: f"grammarbt_{name}.hooks"}
    assert not [other for other in described["dependencies"] if other.startswith("grammarbt-")]


@pytest.mark.parametrize("folder", PLUGINS, ids=lambda path: path.name)
def test_a_plugin_is_known_to_the_tools(folder):
    assert f"-e ./plugins/{folder.name}" in (ROOT / "requirements-dev.txt").read_text(encoding="utf-8")
    tools = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]
    assert f"plugins/{folder.name}/src" in tools["mypy"]["mypy_path"]
    assert folder.name.replace("-", "_") in tools["ruff"]["lint"]["isort"]["known-first-party"]


def test_every_plugin_of_the_project_loads():
    found = {plugin.distribution: plugin.status for plugin in PluginHost(PluginOptions(), lambda _: None).plugins}
    assert {folder.name for folder in PLUGINS} <= {name for name, status in found.items() if status == "ok"}
