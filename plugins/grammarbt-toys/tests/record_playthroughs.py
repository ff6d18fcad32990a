"""Write the playthroughs anew, after a world was changed on purpose: `python record_playthroughs.py`."""

from pathlib import Path

from grammarbt.bt import parse
from grammarbt.domain.playthrough import playthrough
from grammarbt_toys.ant import Ant
from grammarbt_toys.foraging import Foraging
from grammarbt_toys.parameters import ForagingParameters
from grammarbt_toys.platformer import Platformer
from grammarbt_toys.taskselection import TaskSelection

FOLDER = Path(__file__).with_name("playthroughs")
WORLDS = {
    "taskselection": (TaskSelection(), (0,)),
    "ant": (Ant(), (0,)),
    "foraging": (Foraging(ForagingParameters(size=12, robots=2, sites=1, food=3, steps=40)), (0, 1)),
    "platformer": (Platformer(), (1, 5)),
}
"""By file the domain and the scenarios."""


def tell(world):
    """The text of a file: the first reference tree in those scenarios."""
    domain, scenarios = WORLDS[world]
    tree = parse(domain.references[0].tree)
    return "\n".join(playthrough(domain, tree, scenario) for scenario in scenarios)


if __name__ == "__main__":
    for name in WORLDS:
        (FOLDER / f"{name}.txt").write_text(tell(name), encoding="utf-8")
