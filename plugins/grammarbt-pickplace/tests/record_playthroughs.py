"""Write the playthroughs anew, after the simulator was changed on purpose: `python record_playthroughs.py`."""

from functools import partial
from pathlib import Path

from grammarbt.testing import Playthroughs
from grammarbt_pickplace.domain import PickPlace
from grammarbt_pickplace.parameters import PickPlaceParameters

TASKS = {
    "S1": (PickPlaceParameters("S1"), (0,)),
    "S2": (PickPlaceParameters("S2"), (0,)),
    "S3": (PickPlaceParameters("S3"), (0,)),
    "S1_stochastic": (PickPlaceParameters("S1", stochastic=True), (5, 8)),
}
PLAYTHROUGHS = Playthroughs(
    Path(__file__).with_name("playthroughs"),
    {name: (partial(PickPlace, parameters), scenarios) for name, (parameters, scenarios) in TASKS.items()},
)

if __name__ == "__main__":
    PLAYTHROUGHS.record()
