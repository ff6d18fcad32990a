"""An episode as the log that BehaviorTree.CPP writes (its FileLogger2, `.btlog`) and Groot2 shows.

    "BTCPP4-FileLogger2", a byte 1 for the protocol
    length of the XML (4 bytes), the XML, in which each node has a `_uid`
    time of the beginning in µs (8 bytes)
    then for each change of a node: µs since the beginning (6 bytes), `_uid` (2 bytes), status (1 byte)

All numbers are little-endian.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import count
from typing import TYPE_CHECKING

from grammarbt.bt import BehaviorTree, Parallel, Status, children
from grammarbt.bt.formats import btcpp
from grammarbt.errors import FormatError
from grammarbt.report.recording import statuses_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grammarbt.bt import Node
    from grammarbt.domain import Episode
    from grammarbt.report.recording import Statuses

_MAGIC = b"BTCPP4-FileLogger2\x01"
_CODES = {Status.RUNNING: 1, Status.SUCCESS: 2, Status.FAILURE: 3}
_IDLE, _RUNNING = 0, 1
_TICK = 100_000
"""Microseconds from one tick to the next; the simulators have no clock that tells more."""

_MOST_NODES = 2**16 - 1


def dumps(tree: BehaviorTree, episode: Episode) -> bytes:
    """Write an episode.

    Raises:
        FormatError: the tree has more nodes than the log can number, or cannot be written for BehaviorTree.CPP.
    """
    xml = numbered_xml(tree).encode()
    log = _Log(tree)
    body = b"".join(
        (tick * _TICK + at).to_bytes(6, "little") + uid.to_bytes(2, "little") + bytes([status])
        for tick, statuses in enumerate(statuses_of(tree, episode))
        for at, (uid, status) in enumerate(log.tick(statuses))
    )
    return _MAGIC + len(xml).to_bytes(4, "little") + xml + bytes(8) + body


def numbered_xml(tree: BehaviorTree) -> str:
    """The tree's XML, in which `_uid` numbers the nodes in pre-order, from 1."""
    numbers = count(1)
    head, middle, tail = re.split(r"(?<=<BehaviorTree ID=\"MainTree\">)|(?=  </BehaviorTree>)", btcpp.dumps(tree))
    found = re.sub(r"^ *<[\w-]+", lambda start: f'{start[0]} _uid="{next(numbers)}"', middle, flags=re.MULTILINE)
    if next(numbers) > _MOST_NODES:
        raise FormatError(f"the log numbers no more than {_MOST_NODES:,} nodes", "choose another format")
    return head + found + tail


class _Log:
    """Follows the nodes through ticks and gives their changes, in the order in which the library makes them."""

    def __init__(self, tree: BehaviorTree) -> None:
        self._below: dict[int, list[int]] = {}
        self._parallel: set[int] = set()
        self._current: dict[int, int] = {}
        self._number(tree, count(1))

    def tick(self, statuses: Statuses) -> Iterator[tuple[int, int]]:
        """Each change of a tick as the node's number and its status; `statuses` are what the nodes answered."""
        yield from self._visit(1, statuses)
        if statuses[0] is not Status.RUNNING:
            yield from self._set(1, _IDLE)

    def _number(self, node: Node, numbers: Iterator[int]) -> int:
        number = next(numbers)
        if isinstance(node, Parallel):
            self._parallel.add(number)
        self._below[number] = [self._number(child, numbers) for child in children(node)]
        return number

    def _visit(self, number: int, statuses: Statuses) -> Iterator[tuple[int, int]]:
        status = statuses[number - 1]
        below = self._below[number]
        if status is None:
            yield from self._halt([number])
            return
        if below:
            yield from self._set(number, _RUNNING)
        for child in below:
            yield from self._visit(child, statuses)
        if status is not Status.RUNNING:
            yield from self._halt(below)
        elif number not in self._parallel:
            yield from self._halt([child for child in below if statuses[child - 1] is not Status.RUNNING])
        yield from self._set(number, _CODES[status])

    def _halt(self, numbers: Sequence[int]) -> Iterator[tuple[int, int]]:
        for number in numbers:
            yield from self._halt(self._below[number])
            yield from self._set(number, _IDLE)

    def _set(self, number: int, status: int) -> Iterator[tuple[int, int]]:
        if self._current.get(number, _IDLE) != status:
            self._current[number] = status
            yield number, status
