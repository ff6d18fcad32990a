"""Write the playthroughs anew, after a world was changed on purpose: `python record_playthroughs.py`."""

from functools import partial
from pathlib import Path

from grammarbt.testing import Playthroughs
from grammarbt_toys.ant import Ant
from grammarbt_toys.foraging import Foraging
from grammarbt_toys.parameters import ForagingParameters
from grammarbt_toys.platformer import Platformer
from grammarbt_toys.taskselection import TaskSelection

SMALL = ForagingParameters(size=12, robots=2, sites=1, food=3, steps=40)
PLAYTHROUGHS = Playthroughs(
    Path(__file__).with_name("playthroughs"),
    {
        "taskselection": (TaskSelection, (0,)),
        "ant": (Ant, (0,)),
        "foraging": (partial(Foraging, SMALL), (0, 1)),
        "platformer": (Platformer, (1, 5)),
    },
)

if __name__ == "__main__":
    PLAYTHROUGHS.record()
