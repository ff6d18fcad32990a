"""Domains: the vocabulary of a robot and the simulator that scores its trees."""

from grammarbt.bt.vocabulary import (
    ActionType,
    ConditionType,
    Group,
    LeafType,
    Vocabulary,
    actions_of,
    conditions_of,
)
from grammarbt.domain.base import (
    FIRST_VALIDATION_SCENARIO,
    MAX_SEED,
    Domain,
    NoParameters,
    Outcome,
    Reference,
    Returns,
    Scenarios,
    scenario_numbers,
)
from grammarbt.domain.episode import Drawing, Episode, Frame, Mark, Role, Shape, Watchable
from grammarbt.domain.tick import TickDomain

__all__ = [
    "FIRST_VALIDATION_SCENARIO",
    "MAX_SEED",
    "ActionType",
    "ConditionType",
    "Domain",
    "Drawing",
    "Episode",
    "Frame",
    "Group",
    "LeafType",
    "Mark",
    "NoParameters",
    "Outcome",
    "Reference",
    "Returns",
    "Role",
    "Scenarios",
    "Shape",
    "TickDomain",
    "Vocabulary",
    "Watchable",
    "actions_of",
    "conditions_of",
    "scenario_numbers",
]
