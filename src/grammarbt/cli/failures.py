"""How a failure looks to the user, and the exit code it gives."""

from __future__ import annotations

import os
import sys

import click

from grammarbt.errors import GrammarBTError

SUCCESS, INTERNAL_ERROR, USER_MISTAKE, INTERRUPTED = 0, 1, 2, 130


def report(error: Exception) -> int:
    """Say what is wrong in one line and what to do in another; findings in a grammar are shown in full."""
    if isinstance(error, GrammarBTError):
        render = getattr(error, "render", None)
        return _mistake(error.message, error.hint) if render is None else _shown(render())
    if isinstance(error, click.UsageError):
        return _usage_mistake(error)
    if isinstance(error, click.ClickException):
        return _mistake(error.format_message())
    if isinstance(error, OSError):
        if error.filename is None:  # the output itself: a full disk
            drop_output()
        return _mistake(f"{error.filename or 'output'}: {error.strerror or error}")
    _line("internal error", f"{type(error).__name__}: {error}, please report; --traceback shows more")
    return INTERNAL_ERROR


def drop_output() -> None:
    """Keep the interpreter from complaining, on its way out, about output that nobody takes."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _usage_mistake(error: click.UsageError) -> int:
    message = error.message if hasattr(error, "possibilities") else error.format_message()
    if message.startswith("Usage:"):  # a group without a verb: click's error is the help page
        return _shown(message)
    near = getattr(error, "possibilities", None)
    path = error.ctx.command_path if error.ctx else "grammarbt"
    hint = f"did you mean {' or '.join(map(repr, near))}?" if near else f"see '{path} --help'"
    return _mistake(message[:1].lower() + message[1:].rstrip("."), hint)


def _mistake(message: str, hint: str | None = None) -> int:
    _line("error", message)
    if hint:
        _line("hint", hint)
    return USER_MISTAKE


def _shown(text: str) -> int:
    print(text, file=sys.stderr)
    return USER_MISTAKE


def _line(label: str, text: str) -> None:
    print(f"{label}: {' '.join(text.splitlines())}", file=sys.stderr)
