"""Write the playthroughs anew, after the simulator was changed on purpose: `python record_playthroughs.py`."""

from pathlib import Path

from grammarbt.bt import parse
from grammarbt.domain.playthrough import playthrough
from grammarbt_marine.domain import Marine
from grammarbt_marine.parameters import MarineParameters

FOLDER = Path(__file__).with_name("playthroughs")
WORLDS = {
    "default": ({}, (0, 1)),
    "sparse": ({"preset": "sparse"}, (0, 3)),
    "scheide": ({"preset": "scheide"}, (0, 1)),
    "team": ({"robots": 2, "horizon": 60}, (0,)),
}
"""By file the parameters and the scenarios."""


def tell(world):
    """The text of a file: the manual tree in those scenarios."""
    parameters, scenarios = WORLDS[world]
    marine = Marine(MarineParameters(**parameters))
    tree = parse(marine.references[0].tree)
    return "\n".join(playthrough(marine, tree, scenario) for scenario in scenarios)


if __name__ == "__main__":
    for name in WORLDS:
        (FOLDER / f"{name}.txt").write_text(tell(name), encoding="utf-8")
