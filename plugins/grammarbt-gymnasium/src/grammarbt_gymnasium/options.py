"""Keyword arguments of an environment, from one text."""

from __future__ import annotations

import json
from typing import Any

from grammarbt.errors import ParameterError


def read_options(text: str) -> dict[str, Any]:
    """Read `key=value,key=value`; a value is a number, true, false, null, or else a text.

    Raises:
        ParameterError: a part is not of that form.
    """
    parts = [part.partition("=") for part in text.split(",") if part.strip()]
    for key, sign, _ in parts:
        if not (sign and key.strip().isidentifier()):
            message = f"cannot read {key.strip()!r} in the environment's options"
            raise ParameterError(message, "write --set domain.options=key=value,key=value")
    return {key.strip(): _value(value.strip()) for key, _, value in parts}


def _value(text: str) -> Any:  # noqa: ANN401 - an environment takes what it takes
    try:
        return json.loads(text)
    except ValueError:
        return text
