"""Parameters of components: from the strings and TOML values of a user to a checked attrs instance."""

from __future__ import annotations

import inspect
import math
import sys
import types
from typing import TYPE_CHECKING, Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

import attrs

from grammarbt.errors import ParameterError, did_you_mean

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

Parameters = TypeVar("Parameters")

_TRUTH = {"true": True, "yes": True, "on": True, "1": True, "false": False, "no": False, "off": False, "0": False}
_EXPECTED: dict[object, str] = {
    int: "an integer",
    float: "a number",
    bool: "true or false",
    str: "a text",
    type(None): "none",
}


@attrs.frozen
class Parameter:
    """One parameter of a component, for people.

    Attributes:
        name: what users type.
        type: what it accepts.
        default: what it is when nothing is said, or None.
        required: whether it must be given.
        help: one sentence.
    """

    name: str
    type: str
    default: object
    required: bool
    help: str


def build(cls: type[Parameters], settings: Mapping[str, object], what: str) -> Parameters:
    """An instance of the attrs class `cls` with the settings given.

    Args:
        cls: fields of type int, float, bool, str, a Literal, or one of these or None; a field's help is its metadata's
            `"help"`.
        settings: strings, as typed after `--set`, or TOML values.
        what: the prefix of the keys, for example ``"searcher"``.

    Raises:
        ParameterError: a key is unknown or missing, or a value has the wrong type or is out of range.
    """
    fields = _fields(cls)
    values: dict[str, object] = {}
    for key, setting in settings.items():
        if key not in fields:
            hint = did_you_mean(key, fields) if fields else f"this {what} has no parameters"
            raise ParameterError(f"unknown parameter {what}.{key}", hint)
        values[key] = _converted(fields[key], setting, f"{what}.{key}")
    for key, spec in fields.items():
        if spec.default is attrs.NOTHING and key not in values:
            raise ParameterError(f"parameter {what}.{key} is missing", f"give it with --set {what}.{key}=VALUE")
    return _instance(cls, values, what)


def describe(cls: type) -> tuple[Parameter, ...]:
    """The parameters of an attrs class, in the order of its fields."""
    return tuple(
        Parameter(
            name,
            _type_text(spec.type),
            _default(spec),
            spec.default is attrs.NOTHING,
            str(spec.metadata.get("help", "")),
        )
        for name, spec in _fields(cls).items()
    )


def _fields(cls: type) -> dict[str, attrs.Attribute[Any]]:
    if not attrs.has(cls):
        raise ParameterError(f"{cls.__qualname__} is not an attrs class", "decorate it with @attrs.frozen")
    return {spec.alias or spec.name: _resolved(cls, spec) for spec in attrs.fields(cls) if spec.init}


def _resolved(cls: type, spec: attrs.Attribute[Any]) -> attrs.Attribute[Any]:
    """The field with its annotation evaluated, in the module of the class that declares it.

    One field at a time: other annotations of the class may name what is imported for type checkers only.
    """
    owner = next((base for base in cls.__mro__ if spec.name in inspect.get_annotations(base)), cls)
    stand_in = types.SimpleNamespace(__annotations__={spec.name: spec.type})
    try:
        hints = get_type_hints(stand_in, vars(sys.modules[owner.__module__]))
    except NameError:
        return spec
    return spec.evolve(type=hints[spec.name])


def _instance(cls: type[Parameters], values: Mapping[str, object], what: str) -> Parameters:
    try:
        return cls(**values)
    except (ValueError, TypeError) as error:
        # The validators of attrs hand over the field and its options after the message.
        text = " ".join(str(error.args[0] if error.args else error).split())
        raise ParameterError(f"{what}: {text}", f"see 'grammarbt plugins NAME' for the {what}'s parameters") from error


def _default(spec: attrs.Attribute[Any]) -> object:
    if spec.default is attrs.NOTHING:
        return None
    factory = getattr(spec.default, "factory", None)
    return factory() if callable(factory) else spec.default


def _converted(spec: attrs.Attribute[Any], setting: object, key: str) -> object:
    for option in _options(spec.type):
        try:
            return _converted_to(option, setting)
        except ValueError:
            continue
    literals = [option for option in _options(spec.type) if get_origin(option) is Literal]
    choices = [str(choice) for option in literals for choice in get_args(option)]
    hint = did_you_mean(str(setting), choices) if choices else str(spec.metadata.get("help", ""))
    raise ParameterError(f"parameter {key} must be {_type_text(spec.type)}, not {setting!r}", hint or None)


def _converted_to(option: object, setting: object) -> object:
    if get_origin(option) is Literal:
        return _choice(option, setting)
    if option not in _CONVERTERS:
        raise ValueError(option)
    return _CONVERTERS[option](setting)


def _options(kind: object) -> list[object]:
    """The simple types a field accepts; None first, so that `none` is not taken for a text."""
    options = list(get_args(kind)) if get_origin(kind) in {Union, types.UnionType} else [kind]
    return sorted(options, key=lambda option: option is not type(None))


def _type_text(kind: object) -> str:
    return " or ".join(_option_text(option) for option in reversed(_options(kind)))


def _option_text(option: object) -> str:
    if get_origin(option) is Literal:
        return "one of " + ", ".join(str(choice) for choice in get_args(option))
    return _EXPECTED.get(option, str(option))


def _choice(option: object, setting: object) -> object:
    for choice in get_args(option):
        if str(choice) == str(setting):
            return choice
    raise ValueError(setting)


def _truth(setting: object) -> bool:
    word = str(setting).lower()
    if word not in _TRUTH:
        raise ValueError(setting)
    return _TRUTH[word]


def _integer(setting: object) -> int:
    if isinstance(setting, bool) or not isinstance(setting, str | int):
        raise ValueError(setting)  # noqa: TRY004 - the caller tries the next type
    return int(setting)


def _number(setting: object) -> float:
    if isinstance(setting, bool) or not isinstance(setting, str | int | float) or math.isnan(float(setting)):
        raise ValueError(setting)
    return float(setting)


def _text(setting: object) -> str:
    if not isinstance(setting, str):
        raise ValueError(setting)  # noqa: TRY004 - the caller tries the next type
    return setting


def _none(setting: object) -> None:
    if setting is not None and str(setting).lower() != "none":
        raise ValueError(setting)


_CONVERTERS: Mapping[object, Callable[[object], object]] = {
    int: _integer,
    float: _number,
    bool: _truth,
    str: _text,
    type(None): _none,
}
