"""The rules of an episode as numbers, worked out from the parameters."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from attrs import frozen

from grammarbt_marine.records import Floats, Records, as_records

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt_marine.parameters import MarineParameters


@frozen(eq=False)
class Rules:
    """The numbers of an episode; arrays are by class (target, mine, object).

    Beliefs are log odds when the sensor detects, and probabilities when it classifies: then a fourth class is nothing.
    """

    horizon: int
    costs_matter: bool
    speed: float
    battery_low: float
    battery_dead: float
    classifies: bool
    right: float
    wrong: float
    false_alarm: Floats
    prior: Floats
    found: Floats
    likely: float
    impossible: float
    disarm_steps: int
    pick_up_steps: int
    reward: Floats
    pick_up_reward: float


def make_rules(parameters: MarineParameters) -> Records:
    """The rules that the parameters state, as one record with the fields of `Rules`."""
    p = parameters
    belief = belief_scale(parameters)
    rules = Rules(
        horizon=p.horizon,
        costs_matter=bool(p.edge_cost == "length" or p.speed < 1.0 or p.battery_low or p.battery_dead),
        speed=p.speed,
        battery_low=p.battery_low or math.inf,
        battery_dead=p.battery_dead or math.inf,
        classifies=p.sensor == "classifier",
        right=p.sensor_accuracy,
        wrong=(1.0 - p.sensor_accuracy) / 3.0,
        false_alarm=np.array([p.target_pf, p.mine_pf, p.object_pf]),
        prior=np.array([belief(share) for share in _shares(p)]),
        found=np.array([belief(p.target_found), belief(p.mine_found), belief(p.object_found)]),
        likely=belief(p.target_likely),
        impossible=belief(0.0),
        disarm_steps=p.disarm_steps,
        pick_up_steps=p.pick_up_steps,
        reward=np.array([p.target_reward, p.mine_reward, p.object_reward]),
        pick_up_reward=p.pick_up_reward,
    )
    return as_records([rules])


def belief_scale(parameters: MarineParameters) -> Callable[[float], float]:
    """From a probability to what the robot's belief of it is kept as."""
    return float if parameters.sensor == "classifier" else log_odds


def log_odds(probability: float) -> float:
    """log(p / (1 − p)), for p from 0 to below 1."""
    return math.log(probability / (1.0 - probability)) if probability > 0.0 else -math.inf


def _shares(parameters: MarineParameters) -> list[float]:
    """The share of vertices with each class, and for a classifier with nothing."""
    p = parameters
    counts = (p.targets, p.mines, p.objects)
    shares = [p.thing_share / 3.0] * 3 if p.thing_share else [count / p.vertices for count in counts]
    return [*shares, 1.0 - sum(shares)] if p.sensor == "classifier" else shares
