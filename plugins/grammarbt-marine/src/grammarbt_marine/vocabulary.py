"""What the marine robot can do and ask, in six groups, and in two more for one whose battery may run down."""

from __future__ import annotations

from grammarbt.bt import Status
from grammarbt.domain import ActionType, ConditionType, Group, Vocabulary

_ARRIVE = frozenset({Status.SUCCESS, Status.RUNNING})
_GO_ON = frozenset({Status.FAILURE, Status.RUNNING})
_WORK = frozenset({Status.SUCCESS, Status.FAILURE, Status.RUNNING})

VOCABULARY = Vocabulary(
    (
        Group(
            "g1",
            actions=(
                ActionType(
                    "go to comms",
                    "Move one edge towards the nearest vertex in comms; success once there.",
                    results=_ARRIVE,
                ),
                ActionType(
                    "report",
                    "Report every target found so far; fails outside comms.",
                    results=frozenset({Status.SUCCESS, Status.FAILURE}),
                ),
            ),
            conditions=(
                ConditionType("in comms", "The robot is at the surface, near enough to the start to be heard."),
                ConditionType("target found", "At some unreported vertex a target is almost certain."),
                ConditionType("at surface", "The robot is at the surface."),
            ),
        ),
        Group(
            "g2",
            actions=(
                ActionType("disarm", "Disarm the mine here, in several steps; fails without a mine.", results=_WORK),
            ),
            conditions=(
                ConditionType("mine found", "A mine is likely at the robot's vertex."),
                ConditionType("is armed", "The robot's vertex has no mine that was disarmed."),
            ),
        ),
        Group(
            "g3",
            actions=(
                ActionType(
                    "pick up",
                    "Pick up the object here, in several steps; fails without an object or with full hands.",
                    results=_WORK,
                ),
                ActionType(
                    "take to drop off",
                    "Move one edge towards the drop-off and deliver there; fails with empty hands.",
                    results=_WORK,
                ),
            ),
            conditions=(
                ConditionType("object found", "The robot carries an object, or one is likely at its vertex."),
                ConditionType("carrying object", "The robot carries an object."),
            ),
        ),
        Group(
            "g4",
            actions=(
                ActionType(
                    "go to likely target",
                    "Move one edge towards the nearest vertex with a likely target; fails when there is none.",
                    results=_GO_ON,
                ),
            ),
            conditions=(
                ConditionType("likely target found", "At some unreported vertex a target is likely, but not certain."),
            ),
        ),
        Group(
            "g5",
            actions=(ActionType("random walk", "Move along a random edge.", results=frozenset({Status.RUNNING})),),
        ),
        Group(
            "g6",
            actions=(
                ActionType(
                    "shortest path",
                    "Move one edge towards the nearest unvisited vertex; fails when all are visited.",
                    results=_GO_ON,
                ),
            ),
        ),
    )
)
"""The groups of the paper."""

EXTENDED_VOCABULARY = Vocabulary(
    (
        *VOCABULARY.groups,
        Group(
            "g7",
            actions=(
                ActionType(
                    "resurface",
                    "Move one edge towards the nearest vertex at the surface; success there.",
                    results=_ARRIVE,
                ),
            ),
            conditions=(ConditionType("battery low", "The robot has travelled far since it was last at the surface."),),
        ),
        Group(
            "g8",
            actions=(
                ActionType(
                    "coverage",
                    "Move one edge towards the next unvisited vertex of a sweep over the area; fails when all are visited.",
                    results=_GO_ON,
                ),
            ),
        ),
    )
)
"""Those and the leaves that only the published simulator has."""
