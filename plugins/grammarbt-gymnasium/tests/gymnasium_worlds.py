"""Domains made once for all tests, and a world of our own whose rules fit into a few lines."""

from functools import cache

import gymnasium
import numpy as np
from gymnasium import spaces

from grammarbt.bt import compile_policy, parse
from grammarbt_gymnasium.domain import GymnasiumDomain
from grammarbt_gymnasium.parameters import GymnasiumParameters


@cache
def domain(env="CartPole-v1", **parameters):
    return GymnasiumDomain(GymnasiumParameters(env=env, **parameters))


def policy(of, tree):
    return compile_policy(parse(tree), of.vocabulary.index)


def returns(of, tree, scenarios):
    return of.simulate(policy(of, tree), np.asarray(scenarios)).returns.tolist()


class Echo(gymnasium.Env):
    """Pays the action's number in each of `length` steps; shows everything a space can be made of."""

    def __init__(self, length=3, actions=3, start=0, ends=True):
        self.length, self.ends = length, ends
        self.action_space = spaces.Discrete(actions, start=start)
        self.observation_space = spaces.Dict(
            {
                "clock": spaces.Discrete(length + 1),
                "lamp": spaces.Discrete(2),
                "switches": spaces.MultiBinary(2),
                "dials": spaces.MultiDiscrete([3, 4], start=[0, 1]),
                "pair": spaces.Tuple((spaces.Discrete(3), spaces.Box(-1.0, 1.0, (2, 2)))),
                "said": spaces.Text(5),
            }
        )

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.time = 0
        return self.seen(), {}

    def step(self, action):
        self.time += 1
        return self.seen(), float(action), self.ends and self.time == self.length, False, {}

    def seen(self):
        return {
            "clock": min(self.time, self.length),
            "lamp": self.time % 2,
            "switches": np.array([1, 0], dtype=np.int8),
            "dials": np.array([2, 4]),
            "pair": (1, self.np_random.uniform(-1.0, 1.0, (2, 2)).astype(np.float32)),
            "said": "hello",
        }


gymnasium.register("Echo-v0", Echo)
