"""The rules of an episode as numbers, worked out from the parameters."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from attrs import frozen
from numpy.typing import NDArray

from grammarbt_marine.records import Floats, Records, as_records

if TYPE_CHECKING:
    from grammarbt_marine.parameters import MarineParameters


@frozen(eq=False)
class Rules:
    """The numbers of an episode; beliefs are log odds, arrays are by class (target, mine, object)."""

    horizon: int
    count: NDArray[np.int64]
    prior: Floats
    false_alarm: Floats
    reward: Floats
    found: Floats
    likely: float
    disarm_steps: int
    pick_up_steps: int


def make_rules(parameters: MarineParameters) -> Records:
    """The rules that the parameters state, as one record with the fields of `Rules`."""
    p = parameters
    count = (p.targets, p.mines, p.objects)
    rules = Rules(
        horizon=p.horizon,
        count=np.array(count, dtype=np.int64),
        prior=np.array([log_odds(number / p.vertices) for number in count]),
        false_alarm=np.array([p.target_pf, p.mine_pf, p.object_pf]),
        reward=np.array([p.target_reward, p.mine_reward, p.object_reward]),
        found=np.array([log_odds(p.target_found), log_odds(p.mine_found), log_odds(p.object_found)]),
        likely=log_odds(p.target_likely),
        disarm_steps=p.disarm_steps,
        pick_up_steps=p.pick_up_steps,
    )
    return as_records([rules])


def log_odds(probability: float) -> float:
    """log(p / (1 − p)), for p from 0 to below 1."""
    return math.log(probability / (1.0 - probability)) if probability > 0.0 else -math.inf
