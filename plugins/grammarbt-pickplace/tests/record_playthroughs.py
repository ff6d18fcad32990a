"""Write the playthroughs anew, after the simulator was changed on purpose: `python record_playthroughs.py`."""

from pathlib import Path

from grammarbt.bt import parse
from grammarbt.domain.playthrough import playthrough
from grammarbt_pickplace.domain import PickPlace
from grammarbt_pickplace.parameters import PickPlaceParameters

FOLDER = Path(__file__).with_name("playthroughs")
WORLDS = {
    "S1": (PickPlaceParameters("S1"), (0,)),
    "S2": (PickPlaceParameters("S2"), (0,)),
    "S3": (PickPlaceParameters("S3"), (0,)),
    "S1_stochastic": (PickPlaceParameters("S1", stochastic=True), (5, 8)),
}
"""By file the parameters and the scenarios."""


def tell(world):
    """The text of a file: the best known tree in those scenarios."""
    parameters, scenarios = WORLDS[world]
    domain = PickPlace(parameters)
    tree = parse(domain.references[0].tree)
    return "\n".join(playthrough(domain, tree, scenario) for scenario in scenarios)


if __name__ == "__main__":
    for name in WORLDS:
        (FOLDER / f"{name}.txt").write_text(tell(name), encoding="utf-8")
