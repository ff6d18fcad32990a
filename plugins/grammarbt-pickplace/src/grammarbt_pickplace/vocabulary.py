"""What the mobile manipulator can do and ask, task by task."""

from __future__ import annotations

from grammarbt.bt import Status
from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary

_NEVER_FAILS = frozenset({Status.SUCCESS, Status.RUNNING})
_NEEDS = "needs to be localised, the head up, the arm tucked or holding"


def _move_to(place: str, where: str) -> ActionType:
    return ActionType(f"move to {place}", f"Drive to {where}; {_NEEDS}.")


_ACTIONS = (
    ActionType("localise", "Find out where the robot is."),
    ActionType("head up", "Raise the head, as moving needs it.", results=_NEVER_FAILS),
    ActionType("head down", "Lower the head, as picking and placing need it.", results=_NEVER_FAILS),
    ActionType("tuck", "Tuck the arm; a held cube is lost and goes back to its start.", results=_NEVER_FAILS),
    _move_to("pick0", "the first pick table"),
    _move_to("place", "the place table"),
    ActionType("pick", "Pick the nearest cube; needs to be localised at a table, the head down, the arm tucked."),
    ActionType("place", "Put the held cube on its goal; needs to be localised at the place table, the head down."),
)
_CONDITIONS = (
    ConditionType("have block", "The robot holds a cube."),
    ConditionType("cube0 placed", "The first cube is on its goal and the robot holds none."),
    ConditionType("task done", "Every cube is on its goal."),
)

_SEARCH_ACTIONS = (_move_to("pick1", "the second pick table"), _move_to("pick2", "the third pick table"))
_SEARCH_CONDITIONS = tuple(
    ConditionType(f"table{table} visited", f"The robot has tried to pick at the {which} pick table.")
    for table, which in enumerate(("first", "second", "third"))
)
_MORE_CUBES = (
    ConditionType("cube1 placed", "The second cube is on its goal and the robot holds none."),
    ConditionType("cube2 placed", "The third cube is on its goal and the robot holds none."),
)

ONE_TABLE = Vocabulary((Group("robot", _ACTIONS, _CONDITIONS),))
THREE_TABLES = Vocabulary((Group("robot", _ACTIONS + _SEARCH_ACTIONS, _CONDITIONS + _SEARCH_CONDITIONS),))
THREE_CUBES = Vocabulary((Group("robot", _ACTIONS + _SEARCH_ACTIONS, _CONDITIONS + _SEARCH_CONDITIONS + _MORE_CUBES),))
