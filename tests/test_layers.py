"""The architecture: imports point down only."""

import ast
import importlib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
CORE = ROOT / "src" / "grammarbt"
LEVELS = {
    "errors": 0, "bt": 1, "grammar": 2, "domain": 3, "search": 4, "plugins": 5, "testing": 6, "run": 6, "report": 7, "cli": 8,
}  # fmt: skip
OPEN_TO_PLUGINS = {"grammar", "bt", "domain", "search", "plugins", "testing"}
PLUGIN_MODULES = sorted((ROOT / "plugins").glob("*/src/**/*.py"))
CORE_MODULES = sorted(path for path in CORE.rglob("*.py") if path.parent != CORE or path.name == "errors.py")


def imports(path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, (), node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}:{node.lineno}: write the whole module name"
            yield node.module, tuple(alias.name for alias in node.names), node.lineno


def part(module):
    names = module.split(".")
    return names[1] if names[0] == "grammarbt" and len(names) > 1 else None


def public_names(module):
    found = importlib.import_module(module)
    return vars(found) if module == "grammarbt.errors" else found.__all__


@pytest.mark.parametrize("path", CORE_MODULES, ids=lambda path: str(path.relative_to(CORE)))
def test_imports_point_down(path):
    own = LEVELS[path.relative_to(CORE).parts[0].removesuffix(".py")]
    wrong = [f"{path}:{line}: {name}" for name, _, line in imports(path) if part(name) and LEVELS[part(name)] > own]
    assert not wrong


@pytest.mark.parametrize("path", PLUGIN_MODULES, ids=lambda path: path.stem)
def test_plugins_use_public_names_only(path):
    own = path.relative_to(ROOT / "plugins").parts[2]
    for module, names, line in imports(path):
        where = f"{path}:{line}: {module}"
        if part(module):
            assert part(module) in OPEN_TO_PLUGINS or module == "grammarbt.errors", where
            assert set(names) <= set(public_names(module)), where
        assert not module.startswith("grammarbt_") or module.split(".")[0] == own, where


def test_the_core_names_no_plugin():
    names = {path.name.removeprefix("grammarbt-") for path in (ROOT / "plugins").iterdir()}
    for path in CORE_MODULES:
        assert not [m for m, _, _ in imports(path) if m.removeprefix("grammarbt_").split(".")[0] in names], path
