"""Pages that follow from the code say what the code says, and public names exist where they are promised."""

import importlib
import importlib.util
import inspect
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


@pytest.mark.parametrize("package", GENERATOR.PACKAGES)
def test_every_public_name_is_there_and_explained(package):
    module = importlib.import_module(f"grammarbt.{package}")
    assert list(module.__all__) == sorted(set(module.__all__), key=list(module.__all__).index)
    for name in module.__all__:
        thing = getattr(module, name)
        if inspect.isclass(thing) or inspect.isfunction(thing):
            assert getattr(thing, "__doc__", None), f"{package}.{name} has no docstring"
