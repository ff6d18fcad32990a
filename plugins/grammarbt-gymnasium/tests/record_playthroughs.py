"""Write the playthroughs anew, after what is shown was changed on purpose: `python record_playthroughs.py`."""

from functools import partial
from pathlib import Path

from grammarbt.testing import Playthroughs
from grammarbt_gymnasium.domain import GymnasiumDomain
from grammarbt_gymnasium.parameters import GymnasiumParameters

WORLDS = {
    "cartpole": GymnasiumParameters(env="CartPole-v1", max_steps=25),
    "minigrid": GymnasiumParameters(env="MiniGrid-Empty-8x8-v0"),
}
PLAYTHROUGHS = Playthroughs(
    Path(__file__).with_name("playthroughs"),
    {name: (partial(GymnasiumDomain, parameters), (0,)) for name, parameters in WORLDS.items()},
)

if __name__ == "__main__":
    PLAYTHROUGHS.record()
