"""Trees as people give them on the command line: notation, a file, or a run's folder."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, cast

from grammarbt.bt import parse
from grammarbt.bt.formats.files import read_text
from grammarbt.errors import NotationError, RunError
from grammarbt.plugins.resolve import load
from grammarbt.run.folder import RunFolder

if TYPE_CHECKING:
    from grammarbt.bt import BehaviorTree
    from grammarbt.plugins import Registry


def load_tree(text: str, registry: Registry) -> BehaviorTree:
    """The tree that a text means: a run's best, a file's, or the notation itself.

    Raises:
        GrammarBTError: there is no such file, or what it holds is no tree.
    """
    path = _existing(text)
    if path is not None:
        return _best_of(path) if path.is_dir() else _from_file(path, registry)
    if not any(bracket in text for bracket in "[("):
        raise RunError(f"there is no file {text!r}, and it is no notation", "a leaf is written [action] or (condition)")
    return parse(text)


def _existing(text: str) -> Path | None:
    """The file or folder of that name, if there is one."""
    try:
        return Path(text) if Path(text).exists() else None
    except (OSError, ValueError):  # notation may be longer than a name can be, and hold what no name can
        return None


def _best_of(path: Path) -> BehaviorTree:
    folder = RunFolder(path)
    if not folder.best.is_file():
        raise RunError(f"{str(path)!r} holds no best.tree", "give the folder of a run that has found a tree")
    return parse(read_text(folder.best))


def _from_file(path: Path, registry: Registry) -> BehaviorTree:
    """The file's tree: notation whatever the file is called, else what its ending says."""
    text = read_text(path)
    try:
        return parse(text)
    except NotationError:
        for spec in registry.formats:
            if spec.importer and path.suffix in spec.suffixes and spec.name != "notation":
                return cast("Callable[[str], BehaviorTree]", load(spec.importer, f"format {spec.name!r}"))(text)
        raise
