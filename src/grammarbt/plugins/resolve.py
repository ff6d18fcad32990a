"""From a name in a text to the object it stands for: dotted paths of plugins, and classes in plain files."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from grammarbt.errors import DomainError, GrammarBTError, PluginError, did_you_mean

if TYPE_CHECKING:
    from types import ModuleType


def load(path: str, owner: str) -> object:
    """The object at the dotted path `"package.module:attribute"`.

    Args:
        path: as a plugin's description gives it.
        owner: whose description it is, for the error.

    Raises:
        PluginError: it cannot be imported, or is not there.
    """
    module, _, attribute = path.partition(":")
    try:
        return getattr(importlib.import_module(module), attribute)
    except GrammarBTError:
        raise
    except Exception as error:
        hint = f"repair or reinstall {owner}"
        raise PluginError(f"{owner} cannot load {path}: {one_line(error)}", hint) from error


def is_file_reference(name: str) -> bool:
    """Whether a domain's name is `FILE.py:NAME`, or a file that lacks its `:NAME`."""
    return ".py:" in name or name.endswith(".py")


def load_from_file(reference: str) -> object:
    """The class or object at `FILE.py:NAME`.

    The file may import what lies next to it.

    Raises:
        DomainError: there is no such file, it does not run, or has no such name.
    """
    file, _, name = reference.rpartition(":") if not reference.endswith(".py") else (reference, "", "")
    module = _module_from(Path(file))
    own = sorted(key for key, thing in vars(module).items() if getattr(thing, "__module__", None) == module.__name__)
    if not name:
        raise DomainError(f"{file} does not say which class to use", f"write {file}:NAME; it has {', '.join(own)}")
    if not hasattr(module, name):
        raise DomainError(f"{file} has no {name!r}", did_you_mean(name, own) if own else f"{file} defines nothing")
    found: object = getattr(module, name)
    return found


def one_line(error: BaseException) -> str:
    """An exception of a stranger's code, as one line."""
    return " ".join(f"{type(error).__name__}: {error}".split())


def _module_from(file: Path) -> ModuleType:
    if not file.is_file():
        raise DomainError(f"there is no file {file}", "give the path of a Python file, then a colon and a class's name")
    name = f"grammarbt_file_{file.stem}"
    spec = importlib.util.spec_from_file_location(name, file)
    if spec is None or spec.loader is None:
        raise DomainError(f"{file} is not a Python file", "its name must end in .py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # attrs and pickle look classes up by their module's name
    # At the end of the path, so that a file next to it cannot hide an installed module.
    sys.path.append(str(file.parent.resolve()))
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        del sys.modules[name]
        raise DomainError(f"{file} does not run: {_with_line(error, file)}", "try it with 'python' first") from error
    return module


def _with_line(error: BaseException, file: Path) -> str:
    if isinstance(error, SyntaxError):
        return f"line {error.lineno}: {type(error).__name__}: {error.msg}"
    line, traceback = 0, error.__traceback__
    while traceback:
        if traceback.tb_frame.f_code.co_filename == str(file):
            line = traceback.tb_lineno
        traceback = traceback.tb_next
    return f"line {line}: {one_line(error)}"
