"""The three published tasks: the cubes, the leaves, and trees to compare with."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from attrs import frozen

from grammarbt.domain import Reference, Vocabulary
from grammarbt_pickplace.vocabulary import ONE_TABLE, THREE_CUBES, THREE_TABLES

if TYPE_CHECKING:
    from grammarbt_pickplace.parameters import TaskName

Point: TypeAlias = tuple[float, float, float]

CUBES: tuple[Point, ...] = ((-1.13053, -6.65365, 0.8625), (-2.32, -11.07, 0.865), (-1.086, -0.545, 0.866))
"""Where cubes start, in metres: on the first, second and third pick table."""


@frozen
class Task:
    """A task.

    Attributes:
        starts: for each run of an episode, where each cube starts; the return is the mean over the runs.
        vocabulary: the leaves.
        references: trees to compare with.
    """

    starts: tuple[tuple[Point, ...], ...]
    vocabulary: Vocabulary
    references: tuple[Reference, ...]


def _reach(table: int) -> str:
    return f"?( (have block) →( [tuck] [move to pick{table}] ) )"


def _look(table: int) -> str:
    return f"?( (table{table} visited) →( {_reach(table)} [head down] [pick] ) )"


def _fetch(cube: int) -> str:
    deliver = "[head down] [pick] [move to place] [place]"
    return f"?( (cube{cube} placed) →( [localise] [head up] {_reach(cube)} {deliver} ) )"


_S1_BEST = f"?( (task done) →( [localise] [head up] {_reach(0)} [head down] [pick] [move to place] [place] ) )"

_S2_SEARCH = (
    "?( (have block) →( [localise] (table1 visited) [move to pick0] )"
    " →( [tuck] (table2 visited) ?( [move to pick1] ) ) [move to pick2] )"
)
_S2_BEST = f"?( (task done) →( [head up] {_S2_SEARCH} [head down] [pick] [move to place] [place] ) )"
_S2_HAND = (
    f"?( (task done) →( [head up] [localise] ?( (have block) →( {_look(0)} {_look(1)} {_look(2)} ) )"
    " [move to place] [head down] [place] ) )"
)

_S3_NEXT = (
    "?( (have block) →( [tuck] (cube0 placed) [move to pick2] ) →( (cube1 placed) [move to pick0] ) [move to pick1] )"
)
_S3_BEST = f"?( (task done) →( [head up] [localise] {_S3_NEXT} [head down] [pick] [move to place] [place] ) )"
_S3_HAND = f"?( (task done) →( {_fetch(0)} {_fetch(1)} {_fetch(2)} ) )"

BEST, HAND = "best known", "hand-written"

TASKS: dict[TaskName, Task] = {
    "S1": Task((CUBES[:1],), ONE_TABLE, (Reference(BEST, _S1_BEST),)),
    "S2": Task(tuple((cube,) for cube in CUBES), THREE_TABLES, (Reference(BEST, _S2_BEST), Reference(HAND, _S2_HAND))),
    "S3": Task((CUBES,), THREE_CUBES, (Reference(BEST, _S3_BEST), Reference(HAND, _S3_HAND))),
}
"""The tasks by name."""
