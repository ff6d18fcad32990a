"""What can go wrong, one class per cause; each error says the thing, the place and the next step."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable


class GrammarBTError(Exception):
    """Base of every error a user can cause; the command line prints it in one line and exits with 2.

    Args:
        message: what is wrong and where, one sentence without a full stop.
        hint: what to do next, or None.
    """

    def __init__(self, message: str, hint: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint

    def __str__(self) -> str:
        return f"{self.message} ({self.hint})" if self.hint else self.message


class GrammarError(GrammarBTError):
    """A `.grammar` file cannot be used."""


class NotationError(GrammarBTError):
    """A text is not a behavior tree in the one-line notation."""


class FormatError(GrammarBTError):
    """A file is not a behavior tree in the format it claims to be."""


class DomainError(GrammarBTError):
    """A domain is broken, or used with leaves it does not have."""


class SearcherError(GrammarBTError):
    """A searcher broke the ask and tell protocol."""


class PluginError(GrammarBTError):
    """A plugin cannot be loaded, or two of them claim one name."""


class ParameterError(GrammarBTError):
    """A parameter is unknown, of the wrong type, or out of range."""


class RunError(GrammarBTError):
    """A run folder cannot be made, read or continued."""


class UnknownNameError(GrammarBTError):
    """A name that nothing carries; the hint offers the nearest ones.

    Args:
        kind: what was looked for, for example ``"domain"``.
        name: the name as the user wrote it.
        known: every name that would have been accepted.
    """

    def __init__(self, kind: str, name: str, known: Iterable[str]) -> None:
        super().__init__(f"unknown {kind} {name!r}", did_you_mean(name, known))
        self.name = name


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """The sentence that helps after a name nobody knows: the nearest names, or all of them."""
    names = sorted(set(known))
    close = get_close_matches(name, names, n=2, cutoff=0.6)
    if close:
        return "did you mean " + " or ".join(repr(match) for match in close) + "?"
    return "known: " + ", ".join(names) if names else "none are installed"
