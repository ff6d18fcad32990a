"""Requests and answers as lines of JSON; `docs/reference/exec-protocol.md` describes them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, TypeAlias
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from grammarbt.bt import Policy, format_leaf, format_tree, leaves
from grammarbt.bt.formats.btcpp import dumps
from grammarbt.domain import Outcome
from grammarbt.errors import DomainError
from grammarbt_exec.lines import read_object

if TYPE_CHECKING:
    from grammarbt.domain import Scenarios

Answer: TypeAlias = Mapping[str, object]

_MOST_TICKS = 2**53
"""From here on JSON readers that know only floating-point numbers cannot count."""

_encode = json.JSONEncoder(ensure_ascii=False, separators=(",", ":")).encode


class Request:
    """What is asked about a tree.

    The id is a check sum of the rest: it does not depend on what was asked before, so neither do errors that show it.

    Args:
        policy: the tree.
        asked: a key that says what, and in which world.

    Attributes:
        id: what the answer must repeat.
        line: the request as a line. Numbers come first, so that a program without a JSON reader finds them.
    """

    def __init__(self, policy: Policy, asked: Mapping[str, object]) -> None:
        columns = (policy.leaf, policy.occurrence, policy.on_success, policy.on_failure, policy.on_running)
        content = {
            **asked,
            "policy": np.stack(columns, axis=1).ravel().tolist(),
            "leaves": [format_leaf(leaf) for leaf in leaves(policy.tree)],
            "tree": format_tree(policy.tree),
            "btcpp": dumps(policy.tree),
        }
        text = _encode(content)
        self.id = crc32(text.encode())
        self.line = f'{{"id":{self.id},{text[1:]}\n'.encode()

    def answer(self, line: bytes) -> Answer:
        """What a line answers.

        Raises:
            ValueError: it is no answer to this request; the text says why.
            DomainError: the program refused, in its own words.
        """
        answer = read_object(line)
        if answer.pop("id", None) != self.id:
            raise ValueError(f"its id is not {self.id}")
        if "error" in answer:
            words = str(answer["error"]).encode(errors="backslashreplace").decode()
            raise DomainError(f"the program refused: {words}")
        return answer


def simulation(policy: Policy, scenarios: Scenarios) -> Request:
    """Asks for the returns of a tree in some scenarios."""
    return Request(policy, {"scenarios": scenarios.tolist()})


def outcome_of(answer: Answer, policy: Policy, scenarios: Scenarios) -> Outcome:
    """The returns and ticks in the answer to a simulation.

    Raises:
        ValueError: there are none; the text says why.
    """
    returns = _numbers(answer, "returns", len(scenarios))
    return Outcome(returns, _ticks(answer, policy.occurrences))


def _ticks(answer: Answer, occurrences: int) -> NDArray[np.int64]:
    if "ticks" not in answer:  # a leaf never ticked could be left out; who does not count must not say so
        return np.ones(occurrences, dtype=np.int64)
    ticks = _numbers(answer, "ticks", occurrences)
    if not ((ticks >= 0) & (ticks < _MOST_TICKS) & (ticks % 1 == 0)).all():
        raise ValueError("its ticks are not counts")
    return ticks.astype(np.int64)


def _numbers(answer: Answer, key: str, expected: int) -> NDArray[np.float64]:
    numbers = answer.get(key)
    if not isinstance(numbers, list) or not all(type(number) in (int, float) for number in numbers):
        raise ValueError(f"{key!r} is not a list of numbers")
    if len(numbers) != expected:
        raise ValueError(f"{key!r} has {len(numbers)} numbers instead of {expected}")
    try:
        array = np.array(numbers, dtype=np.float64)
    except OverflowError:
        array = np.array([np.inf])
    if not np.isfinite(array).all():
        raise ValueError(f"{key!r} has a number that is not finite")
    return array
