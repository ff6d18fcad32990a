"""Pages that follow from the code say what the code says, and public names exist where they are promised."""

import importlib
import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def load_generator():
    spec = importlib.util.spec_from_file_location("make_reference", ROOT / "docs/make_reference.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


GENERATOR = load_generator()


@pytest.mark.parametrize("name", ["cli.md", "hooks.md", "components.md", "api.md"])
def test_page_is_as_the_code_says(name):
    stored = (ROOT / "docs/reference" / name).read_text(encoding="utf-8")
    assert GENERATOR.pages()[name] == stored, "run: python docs/make_reference.py"


@pytest.mark.parametrize("module", GENERATOR.PUBLIC)
def test_public_names_exist_and_are_named_once(module):
    names = list(importlib.import_module(module).__all__)
    assert len(names) == len(set(names))
    assert all(hasattr(importlib.import_module(module), name) for name in names)


def test_every_public_name_is_explained():
    lines = (ROOT / "docs/reference/api.md").read_text(encoding="utf-8").splitlines()
    assert [line for line in lines if line.startswith("- ") and "`: " not in line] == []


def test_a_module_that_says_what_is_public_is_in_the_reference():
    modules = {".".join(path.with_suffix("").relative_to(ROOT / "src").parts) for path in says_what_is_public()}
    named = {module.removesuffix(".__init__") for module in modules}
    assert named - {"grammarbt.cli"} == set(GENERATOR.PUBLIC)  # of the command line it is the verbs that are promised


def says_what_is_public():
    paths = sorted((ROOT / "src").rglob("*.py"))
    return [path for path in paths if "\n__all__ = " in path.read_text(encoding="utf-8")]
