"""What can be reached from somewhere, step by step."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import TypeVar

Place = TypeVar("Place", bound=Hashable)


def reachable(start: Place, after: Callable[[Place], Iterable[Place]]) -> Iterator[Place]:
    """The start and all that lies behind it, nearest first, each once; no further than the caller looks."""
    met, queue = {start}, deque([start])
    while queue:
        place = queue.popleft()
        yield place
        for other in after(place):
            if other not in met:
                met.add(other)
                queue.append(other)
