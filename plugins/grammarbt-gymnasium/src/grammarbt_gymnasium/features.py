"""What an observation says: features, each a place in a row of numbers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
from attrs import evolve, frozen
from gymnasium import spaces

from grammarbt.errors import DomainError

MOST_FEATURES = 128
MOST_VALUES = 1_000
"""Of one choice; each is a condition of its own."""

Values: TypeAlias = Sequence[float]
"""The features of one observation."""


@frozen
class Number:
    """A measurement; bounds may be infinite."""

    name: str
    low: float = -np.inf
    high: float = np.inf


@frozen
class Choice:
    """One of finitely many values; the feature is the value's place among the labels.

    Attributes:
        name: what it is.
        labels: what its values are called.
        ordered: whether the values count something.
    """

    name: str
    labels: tuple[str, ...]
    ordered: bool = False


@frozen
class Flag:
    """Something that holds or not: 1 or 0."""

    name: str


Feature: TypeAlias = Number | Choice | Flag


@frozen(eq=False)
class View:
    """How an observation is read: its features, and the function that gives their values."""

    features: tuple[Feature, ...]
    read: Callable[[Any], Values]


def space_view(space: spaces.Space[Any], names: Sequence[str] = (), *, ordered: bool = False) -> View:
    """The features of any observation made of numbers and choices; parts that are texts or graphs are left out.

    Args:
        space: of the observations.
        names: of the features, if they are known.
        ordered: whether discrete values count something.

    Raises:
        DomainError: no part can be read, or there are more features than a tree could ask for.
    """
    view = _view(space, "", ordered)
    if view is None:
        raise DomainError(f"observations cannot be read: {space}", "wrap the environment so that it observes numbers")
    if len(view.features) > MOST_FEATURES:
        message = f"an observation has {len(view.features)} numbers, more than {MOST_FEATURES}"
        raise DomainError(message, "wrap the environment so that it observes a few features instead of an image")
    return _renamed(view, names)


def _view(space: spaces.Space[Any], name: str, ordered: bool) -> View | None:
    if isinstance(space, spaces.Box):
        return _box(space, name)
    if isinstance(space, spaces.Discrete):
        return _discrete(space, name, ordered)
    if isinstance(space, spaces.MultiDiscrete):
        return _multi_discrete(space, name, ordered)
    if isinstance(space, spaces.MultiBinary):
        names = _numbered(name, int(np.prod(space.shape)))
        return View(tuple(Flag(own) for own in names), lambda seen: np.ravel(seen).tolist())
    return _parts(space, name, ordered)


def _parts(space: spaces.Space[Any], name: str, ordered: bool) -> View | None:
    if isinstance(space, spaces.Tuple):
        return _joined([(at, _view(part, f"{name or 'obs'}{at}", ordered)) for at, part in enumerate(space.spaces)])
    if isinstance(space, spaces.Dict):
        return _joined([(key, _view(part, f"{name} {key}".strip(), ordered)) for key, part in space.spaces.items()])
    return None


def _multi_discrete(space: spaces.MultiDiscrete, name: str, ordered: bool) -> View:
    start = space.start.ravel()
    rows = zip(_numbered(name, start.size), start.tolist(), space.nvec.ravel().tolist(), strict=True)
    features = tuple(Choice(own, _labels(first, n), ordered) for own, first, n in rows)
    return View(features, lambda seen: (np.ravel(seen) - start).tolist())


def _box(space: spaces.Box, name: str) -> View:
    bounds = zip(space.low.ravel().tolist(), space.high.ravel().tolist(), strict=True)
    names = _numbered(name, space.low.size)
    features = tuple(Number(own, low, high) for own, (low, high) in zip(names, bounds, strict=True))
    flat = len(space.shape) == 1
    return View(features, (lambda seen: seen.tolist()) if flat else (lambda seen: np.ravel(seen).tolist()))


def _discrete(space: spaces.Discrete[Any], name: str, ordered: bool) -> View:
    start, n = int(space.start), int(space.n)
    if n == 2:  # noqa: PLR2004 - yes and no
        return View((Flag(name or "state"),), lambda seen: (seen - start,))
    return View((Choice(name or "state", _labels(start, n), ordered),), lambda seen: (seen - start,))


def _joined(parts: Sequence[tuple[Any, View | None]]) -> View | None:
    """The views of the parts, one after the other, without those that cannot be read."""
    kept = [(key, view) for key, view in parts if view is not None]
    if not kept:
        return None
    readers = [(key, view.read) for key, view in kept]
    return View(
        tuple(feature for _, view in kept for feature in view.features),
        lambda seen: [value for key, read in readers for value in read(seen[key])],
    )


def _renamed(view: View, names: Sequence[str]) -> View:
    if len(names) != len(view.features):
        return view
    renamed = (evolve(feature, name=name) for feature, name in zip(view.features, names, strict=True))
    return View(tuple(renamed), view.read)


def _labels(start: int, n: int) -> tuple[str, ...]:
    if n > MOST_VALUES:
        hint = "wrap the environment so that it observes the parts of what this number stands for"
        raise DomainError(f"an observation has {n:,} values, more than {MOST_VALUES:,}", hint)
    return tuple(str(start + number) for number in range(n))


def _numbered(name: str, n: int) -> list[str]:
    own = name or "obs"
    return [own] if n == 1 else [f"{own}{number}" for number in range(n)]
