"""Write the playthroughs anew, after the simulator was changed on purpose: `python record_playthroughs.py`."""

from functools import partial
from pathlib import Path

from grammarbt.testing import Playthroughs
from grammarbt_marine.domain import Marine
from grammarbt_marine.parameters import MarineParameters

WORLDS = {
    "default": (MarineParameters(), (0, 1)),
    "sparse": (MarineParameters(preset="sparse"), (0, 3)),
    "scheide": (MarineParameters(preset="scheide"), (0, 1)),
    "team": (MarineParameters(robots=2, horizon=60), (0,)),
}
PLAYTHROUGHS = Playthroughs(
    Path(__file__).with_name("playthroughs"),
    {name: (partial(Marine, parameters), scenarios) for name, (parameters, scenarios) in WORLDS.items()},
)

if __name__ == "__main__":
    PLAYTHROUGHS.record()
