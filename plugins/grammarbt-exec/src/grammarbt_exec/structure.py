"""JSON values as attrs objects: typed as declared, and with the place of what is not, as `$.frames[2].reward`."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Mapping
from functools import lru_cache
from itertools import repeat
from typing import Any, Literal, NoReturn, TypeVar, get_args, get_origin, get_type_hints

import attrs

from grammarbt.bt import Status

Structured = TypeVar("Structured")

STATUSES = {"success": Status.SUCCESS, "failure": Status.FAILURE, "running": Status.RUNNING}
"""As programs write them."""

_SHOWN = 60
_NAMES = {str: "a text", bool: "true or false", int: "an integer"}


def structured(found: object, kind: type[Structured]) -> Structured:
    """The object of an attrs class that a JSON object stands for.

    Raises:
        ValueError: it is none; the text says what is wrong, and where.
    """
    made: Structured = _object(found, kind, "$")
    return made


def refuse(what: str, where: str) -> NoReturn:
    """Say what is wrong in a line, and where.

    Raises:
        ValueError: always.
    """
    raise ValueError(f"{what} @ {where}")


def _value(found: object, kind: Any, where: str) -> Any:  # noqa: ANN401 - whatever an attribute is declared as
    origin, parts = get_origin(kind), get_args(kind)
    if origin is tuple:
        return _list(found, parts, where)
    if origin is Mapping:
        entries = ((key, value, f"{where}[{_brief(key)}]") for key, value in _entries(found, where).items())
        return {_plain(key, parts[0], place): _value(value, parts[1], place) for key, value, place in entries}
    if origin is Literal:
        return _one_of(found, {each: each for each in parts}, where)
    if kind is Status:
        return _one_of(found, STATUSES, where)
    if kind is float:
        return _number(found, where)
    return _object(found, kind, where) if attrs.has(kind) else _plain(found, kind, where)


def _object(found: object, kind: Any, where: str) -> Any:  # noqa: ANN401 - an attrs class, and one of it
    if isinstance(found, str) and getattr(kind, "plain", False):
        return kind(_plain(found, str, where))
    entries, kinds = _entries(found, where), _kinds(kind)
    for key in entries:
        if key not in kinds:
            refuse(f"there is no key {_brief(key)}, only {', '.join(kinds)}", where)
    for field in attrs.fields(kind):
        if field.default is attrs.NOTHING and field.name not in entries:
            refuse("required field missing", f"{where}.{field.name}")
    return kind(**{key: _value(value, kinds[key], f"{where}.{key}") for key, value in entries.items()})


@lru_cache(maxsize=32)
def _kinds(kind: type) -> dict[str, Any]:
    """The types of its attributes."""
    hints = get_type_hints(kind)
    return {field.name: hints[field.name] for field in attrs.fields(kind)}


def _entries(found: object, where: str) -> dict[str, object]:
    return found if isinstance(found, dict) else refuse("not a JSON object", where)


def _list(found: object, kinds: tuple[Any, ...], where: str) -> tuple[Any, ...]:
    if not isinstance(found, list):
        refuse(f"{_brief(found)} is not a list", where)
    endless = kinds[-1] is Ellipsis
    if not endless and len(found) != len(kinds):
        refuse(f"{len(found)} values instead of {len(kinds)}", where)
    rows = zip(found, repeat(kinds[0]) if endless else kinds, strict=False)
    return tuple(_value(value, kind, f"{where}[{place}]") for place, (value, kind) in enumerate(rows))


def _one_of(found: object, known: Mapping[Any, Any], where: str) -> Any:  # noqa: ANN401 - texts, numbers, statuses
    for name, meant in known.items():
        if found == name and type(found) is type(name):  # true is no 1
            return meant
    return refuse(f"{_brief(found)} is not one of {', '.join(map(str, known))}", where)


def _number(found: object, where: str) -> float:
    if not isinstance(found, int | float) or isinstance(found, bool):
        refuse(f"{_brief(found)} is not a number", where)
    number = float(found) if abs(found) <= sys.float_info.max else math.inf
    return number if math.isfinite(number) else refuse("a number that is not finite", where)


def _plain(found: object, kind: type, where: str) -> object:
    if type(found) is not kind:
        refuse(f"{_brief(found)} is not {_NAMES[kind]}", where)
    if isinstance(found, str) and found != found.encode(errors="ignore").decode():
        refuse(f"{_brief(found)} holds half of a surrogate pair", where)
    return found


def _brief(found: object) -> str:
    text = "a list" if isinstance(found, list) else "an object" if isinstance(found, dict) else json.dumps(found)
    return text if len(text) <= _SHOWN else text[:_SHOWN] + "…"
