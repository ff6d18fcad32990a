"""A package's sources as part of a function's name, for caches on disk that look at one file only."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import TypeVar

__all__ = ["stamped"]

Function = TypeVar("Function", bound=Callable[..., object])


def stamped(function: Function) -> Function:
    """Let the function's qualified name end with a checksum over all sources of its package.

    numba keeps a compiled function on disk under its qualified name, with all that it calls and every constant that it
    reads. It notices a change in the function's own file, but none in files that this one imports; under another name it
    compiles anew. So `numba.njit(cache=True)(stamped(function))` may call functions of other files of the package, as
    long as those are not cached themselves.
    """
    function.__qualname__ += f"_{_checksum(function.__module__.partition('.')[0])}"
    return function


@cache
def _checksum(package: str) -> str:
    checksum = hashlib.sha256()
    for source in _sources(files(package)):
        checksum.update(source.name.encode())
        checksum.update(source.read_bytes())
    return checksum.hexdigest()[:16]


def _sources(folder: Traversable) -> Iterator[Traversable]:
    for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
        if entry.is_dir():
            yield from _sources(entry)
        elif entry.name.endswith(".py"):
            yield entry
