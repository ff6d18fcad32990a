"""What a check says."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Literal, TypeAlias, TypeVar

import numpy as np
from attrs import frozen

Subject = TypeVar("Subject")
Check: TypeAlias = Callable[[Subject], str | None]
"""Raises `NonconformityError`, or gives None, or the reason why it does not apply."""


class NonconformityError(AssertionError):
    """A component does not do what its protocol promises.

    Args:
        seen: what was seen, with the case that shows it.
        advice: what it breaks, and how to repair it.
    """

    def __init__(self, seen: str, advice: str) -> None:
        super().__init__(f"{seen}\n  {advice}")
        self.seen = seen
        self.advice = advice


@frozen
class Verdict:
    """The outcome of one check.

    Attributes:
        check: its name, as words.
        status: `"not applicable"` when the component lacks what it is about.
        seen: what was seen, or why it does not apply.
        advice: what to do.
    """

    check: str
    status: Literal["ok", "failed", "not applicable"]
    seen: str = ""
    advice: str = ""


def verdicts(checks: Iterable[Check[Subject]], subject: Subject) -> Iterator[Verdict]:
    """Make the checks, one after the other."""
    for check in checks:
        name = name_of(check)
        try:
            reason = check(subject)
        except NonconformityError as error:
            yield Verdict(name, "failed", error.seen, error.advice)
        except Exception as error:  # noqa: BLE001 - whatever a stranger's code raises is a finding
            text = " ".join(f"{type(error).__name__}: {error}".split())
            yield Verdict(
                name,
                "failed",
                f"it raised {text}",
                "nothing may be raised here; the check is a plain function, to be called under a debugger",
            )
        else:
            yield Verdict(name, "ok") if reason is None else Verdict(name, "not applicable", reason)


def name_of(check: Callable[..., object]) -> str:
    """A check's name, as words."""
    return check.__name__.removeprefix("check_").replace("_", " ")


def require(holds: bool, seen: str, advice: str) -> None:
    """Raise unless it holds."""
    if not holds:
        raise NonconformityError(seen, advice)


@contextmanager
def untouched_randomness(who: str, advice: str) -> Iterator[None]:
    """Raise unless the global states of `random` and `numpy.random` are afterwards what they were."""
    before = _global_randomness()
    yield
    require(before == _global_randomness(), f"{who} changed the state of `random` or `numpy.random`", advice)


def _global_randomness() -> tuple[object, ...]:
    name, keys, *rest = np.random.get_state()  # noqa: NPY002 - it is the global state that is watched
    return random.getstate(), name, np.asarray(keys).tobytes(), *rest
