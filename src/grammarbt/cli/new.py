"""`grammarbt new`: a working plugin to edit."""

from __future__ import annotations

import keyword
import re
from importlib import resources
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING

import click

from grammarbt.errors import ParameterError, RunError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from importlib.resources.abc import Traversable

_NAME = re.compile(r"[a-z][a-z0-9]*([_-][a-z0-9]+)*")
_ENDING = ".template"


@click.command("new")
@click.argument("kind", type=click.Choice(["domain", "searcher"]))
@click.argument("name")
@click.option("--out", type=click.Path(path_type=Path), metavar="DIR", help="Where; grammarbt-NAME unless given.")
def command(kind: str, name: str, out: Path | None) -> None:
    """Write a distribution that installs, passes the conformance kit and learns something."""
    words = _words(name)
    folder = out or Path(f"grammarbt-{name}")
    _write(kind, folder, words)
    example = f"--domain {name}" if kind == "domain" else f"--searcher {name}"
    print(f"{folder} holds the {kind} {name!r}. Go on with")
    print(f"    pip install -e '{folder}[test]'")
    print(f"    grammarbt check {kind} {name}")
    print(f"    grammarbt run {example} --budget 2000")


def _words(name: str) -> Mapping[str, str]:
    """What the templates leave open."""
    if not _NAME.fullmatch(name) or keyword.iskeyword(name):
        raise ParameterError(
            f"{name!r} cannot be a plugin's name", "use small letters, digits and hyphens, as in warehouse or my-robot"
        )
    module = name.replace("-", "_")
    class_name = "".join(part.capitalize() for part in module.split("_"))
    return {"name": name, "package": f"grammarbt_{module}", "class_name": class_name}


def _write(kind: str, folder: Path, words: Mapping[str, str]) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.iterdir()):
            raise RunError(f"{str(folder)!r} is not empty", "choose another folder with --out")
        for place, text in _templates(resources.files("grammarbt.cli") / "templates" / kind):
            file = folder / _place(place, words)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(Template(text).substitute(words), encoding="utf-8")
    except OSError as error:
        raise RunError(f"cannot write {str(folder)!r}: {error.strerror}", "choose another folder with --out") from None


def _templates(folder: Traversable, above: str = "") -> Iterator[tuple[str, str]]:
    """Every template below a folder: its path and its text."""
    for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
        path = f"{above}{entry.name}"
        if entry.is_dir():
            yield from _templates(entry, f"{path}/")
        elif path.endswith(_ENDING):
            yield path, entry.read_text(encoding="utf-8")


def _place(path: str, words: Mapping[str, str]) -> Path:
    """Where a template's text goes: `package` stands for the package's name, a lone `grammar` for the grammar file."""
    parts = path.removesuffix(_ENDING).split("/")
    names = {
        "package": words["package"],
        "grammar": f"{words['name']}.grammar",
        "test_package.py": f"test_{words['package']}.py",
    }
    return Path(*(names.get(part, part) for part in parts))
