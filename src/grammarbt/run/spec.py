"""What to run: read from TOML, overridden by the command line, written back as TOML."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Mapping
from functools import cached_property
from math import inf
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, cast, get_args

from attrs import Attribute, AttrsInstance, asdict, evolve, field, fields, frozen
from attrs.validators import optional

from grammarbt.domain import MAX_SEED
from grammarbt.errors import ParameterError, RunError, UnknownNameError, did_you_mean

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from pathlib import Path

Part: TypeAlias = Literal["searcher", "domain", "executor"]
PARTS: tuple[Part, ...] = get_args(Part)

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")


def _whole(least: int, most: float = inf) -> Callable[[object, Attribute[int], int], None]:
    def check(_: object, attribute: Attribute[int], value: object) -> None:
        if isinstance(value, bool) or not isinstance(value, int):
            raise ParameterError(f"{attribute.name} must be a whole number, not {value!r}")
        _check_range(attribute.name, value, least, most)

    return check


def _real(least: float, most: float = inf) -> Callable[[object, Attribute[float], float], None]:
    def check(_: object, attribute: Attribute[float], value: object) -> None:
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise ParameterError(f"{attribute.name} must be a number, not {value!r}")
        _check_range(attribute.name, value, least, most)

    return check


def _check_range(name: str, value: float, least: float, most: float) -> None:
    if not least <= value <= most:
        span = f"from {least:g} to {most:,g}" if most < inf else f"of {least:g} or more"
        raise ParameterError(f"{name} cannot be {value}", f"choose a number {span}")


def _text(_: object, attribute: Attribute[str], value: object) -> None:
    if not isinstance(value, str) or not value.strip():
        raise ParameterError(f"{attribute.name} must be a text, not {value!r}")


def _settings(_: object, __: Attribute[object], value: object) -> None:
    if not isinstance(value, dict) or not all(isinstance(part, dict) for part in value.values()):
        raise ParameterError("the settings must be tables", "write for example [set.searcher]")
    for part in value:
        if part not in PARTS:
            raise UnknownNameError("part of a run", part, PARTS)


@frozen(slots=False)  # slots=False: cached_property keeps its value in the instance's dict
class RunSpec:
    """A run, as the user asked for it.

    Attributes:
        domain: a domain's name, or `FILE.py:NAME`.
        searcher: a searcher's name.
        grammar: a grammar's name or file; None for the domain's own.
        executor: an executor's name; None for serial, or processes when there is more than one worker.
        budget: episodes to simulate, the final selection included.
        seed: fixes everything random.
        batch: trees asked for at a time.
        workers: simulations side by side.
        out: the run folder, new or empty; None for a fresh one under `runs/`.
        start: a tree to begin from.
        trials: stop after so many trials.
        seconds: stop after so much time.
        target: stop when the best mean return reaches it.
        stagnation: stop when no better tree was found for so many episodes.
        validation: episodes that the final tree and the reference are scored on.
        selection: share of the budget spent on choosing among the searcher's candidates.
        snapshot: seconds between two snapshots of a searcher that can make them.
        set: parameters of the searcher, the domain and the executor.
    """

    domain: str = field(default="marine", validator=_text)
    searcher: str = field(default="dagmcts", validator=_text)
    grammar: str | None = field(default=None, validator=optional(_text))
    executor: str | None = field(default=None, validator=optional(_text))
    budget: int = field(default=5_000, validator=_whole(1))
    seed: int = field(default=0, validator=_whole(0, MAX_SEED))
    batch: int = field(default=1, validator=_whole(1))
    workers: int = field(default=1, validator=_whole(1))
    out: str | None = field(default=None, validator=optional(_text))
    start: str | None = field(default=None, validator=optional(_text))
    trials: int | None = field(default=None, validator=optional(_whole(1)))
    seconds: float | None = field(default=None, validator=optional(_real(0)))
    target: float | None = field(default=None, validator=optional(_real(-inf)))
    stagnation: int | None = field(default=None, validator=optional(_whole(1)))
    validation: int = field(default=2_000, validator=_whole(2, 2**30))
    selection: float = field(default=0.1, validator=_real(0, 0.9))
    snapshot: float = field(default=60.0, validator=_real(0))
    set: Mapping[Part, Mapping[str, object]] = field(factory=dict, validator=_settings)

    @property
    def executor_name(self) -> str:
        """The executor's name, also when none is given."""
        return self.executor or ("serial" if self.workers == 1 else "processes")

    @property
    def selection_episodes(self) -> int:
        """Episodes of the budget that are kept for the final selection; at least one is left to search."""
        return min(round(self.budget * self.selection), self.budget - 1)

    @cached_property
    def search_episodes(self) -> int:
        """Episodes of the budget that the search may spend."""
        return self.budget - self.selection_episodes

    def settings(self, part: Part) -> Mapping[str, object]:
        """The parameters given for a part."""
        return self.set.get(part, {})

    def overridden(self, options: Mapping[str, object], settings: Mapping[Part, Mapping[str, object]]) -> RunSpec:
        """This spec with the options that are not None, and the settings on top of its own."""
        given = cast("dict[str, Any]", {name: value for name, value in options.items() if value is not None})
        merged = {part: {**self.settings(part), **settings.get(part, {})} for part in PARTS}
        return evolve(self, **given, set={part: values for part, values in merged.items() if values})

    def to_toml(self) -> str:
        """TOML that `read_spec` reads back to the same spec."""
        values = {name: value for name, value in asdict(self, recurse=False).items() if value is not None}
        values.pop("set")
        lines = [f"{name} = {_toml(value)}" for name, value in values.items()]
        for part, settings in self.set.items():
            lines += ["", f"[set.{part}]", *(f"{_key(name)} = {_toml(value)}" for name, value in settings.items())]
        return "\n".join(lines) + "\n"


def read_spec(path: Path) -> RunSpec:
    """Read a TOML file.

    Raises:
        RunError: the file cannot be read, or is not TOML.
        ParameterError: a field is unknown or has a wrong value.
    """
    content = read_toml(path, RunSpec, "grammarbt run")
    try:
        return RunSpec(**content)
    except ParameterError as error:
        raise ParameterError(f"{path}: {error.message}", error.hint) from None


def read_toml(path: Path, spec: type[AttrsInstance], verb: str) -> dict[str, Any]:
    """The content of a TOML file, with no field that the attrs class `spec` lacks.

    Raises:
        RunError: the file cannot be read, or is not TOML; the verb's help has an example.
        ParameterError: a field is unknown.
    """
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise RunError(f"cannot read {str(path)!r}: {error.strerror}", "check the path") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise RunError(f"{path} is not TOML: {error}", f"see '{verb} --help' for an example") from None
    known = [attribute.name for attribute in fields(spec)]
    for name in content:
        if name not in known:
            raise ParameterError(f"{path} has an unknown field {name!r}", did_you_mean(name, known))
    return content


def settings_of(texts: Iterable[str], parts: Sequence[Part] = PARTS) -> dict[Part, dict[str, object]]:
    """Read texts like `searcher.c=1.4`; the values stay texts until their parameter is known.

    Raises:
        ParameterError: a text does not look like that, or names a part that is not among `parts`.
    """
    found: dict[Part, dict[str, object]] = {}
    for text in texts:
        name, equals, value = text.partition("=")
        part, dot, key = name.strip().partition(".")
        if not equals or not dot or not key:
            raise ParameterError(f"cannot read the setting {text!r}", f"write it as {parts[0]}.KEY=VALUE")
        owner = next((known for known in parts if known == part), None)
        if owner is None:
            raise ParameterError(
                f"the setting {text!r} names no part that has settings here", did_you_mean(part, parts)
            )
        found.setdefault(owner, {})[key] = value.strip()
    return found


def _key(name: str) -> str:
    return name if _BARE_KEY.fullmatch(name) else _toml(name)


def _toml(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    raise ParameterError(f"{value!r} cannot stand in a spec", "use texts, numbers, true, false and lists of these")
