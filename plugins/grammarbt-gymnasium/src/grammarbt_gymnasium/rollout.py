"""A short random roll-out that shows what values observations take."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from grammarbt_gymnasium.environment import Environment
    from grammarbt_gymnasium.features import View

LONGEST_HOLD = 8
"""Steps for which an action is kept at most: pushing back and forth at every step would lead nowhere."""


def random_rollout(environment: Environment, view: View, steps: int) -> NDArray[np.float64]:
    """The features seen in each step of episodes with random actions; always the same.

    Returns:
        (steps, features).
    """
    env, actions, rng = environment.env, environment.actions, np.random.default_rng(0)
    seen, left, hold, action = [], 0, 0, 0
    for step in range(steps):
        if not left:
            observation, _ = env.reset(seed=step)
            left = environment.max_steps
        seen.append(view.read(observation))
        if not hold:
            hold, action = int(rng.integers(1, LONGEST_HOLD + 1)), int(actions.start + rng.integers(actions.n))
        observation, _, terminated, truncated, _ = env.step(action)
        left, hold = 0 if terminated or truncated else left - 1, hold - 1
    return np.array(seen, dtype=np.float64)
