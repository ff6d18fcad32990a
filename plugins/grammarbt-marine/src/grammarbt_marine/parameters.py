"""The numbers of the marine domain; the defaults are calibrated so that every group of leaves matters.

Lengths are in units of the square sea area's side, times in steps, rewards in points.
"""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

from attrs import field, frozen
from attrs.validators import ge, gt, in_, instance_of, le, lt

from grammarbt_marine.presets import PRESETS, PresetName

Layout: TypeAlias = Literal["nearest", "depths"]
EdgeCost: TypeAlias = Literal["one", "length"]
Sensor: TypeAlias = Literal["detectors", "classifier"]

_COUNT = [instance_of(int), ge(0)]
_STEPS = [instance_of(int), ge(1)]
_PROBABILITY = [gt(0.0), lt(1.0)]  # a certain sensor would make the log odds infinite
_SHARE = [ge(0.0), le(1.0)]
_LENGTH = [gt(0.0), le(10.0)]
_BATTERY = [ge(0.0), le(1e9)]
_REWARD = [ge(-1e6), le(1e6)]


@frozen(init=False)
class MarineParameters:
    """Parameters of the marine domain; a preset replaces some of the defaults, and what is given replaces both.

    Raises:
        ValueError: a number is out of range, or the things to place outnumber the vertices.
    """

    preset: PresetName = field(
        default="default",
        validator=in_(tuple(PRESETS)),
        metadata={"help": "default: calibrated; sparse: few things; scheide: the published simulator's parameters"},
    )
    robots: int = field(
        default=1,
        validator=[instance_of(int), ge(1), le(16)],
        metadata={"help": "robots of the team; each runs the tree on what it knows itself"},
    )

    vertices: int = field(
        default=80,
        validator=[instance_of(int), ge(3), le(500)],
        metadata={"help": "vertices of a roadmap, with the start and the drop-off"},
    )
    layout: Layout = field(
        default="nearest",
        validator=in_(("nearest", "depths")),
        metadata={
            "help": "nearest: each vertex is joined to its nearest; depths: half of the vertices lie under the others, "
            "and vertices within edge_range are joined unless both are at the surface"
        },
    )
    neighbours: int = field(
        default=4, validator=_STEPS, metadata={"help": "layout nearest: vertices that each vertex is joined to"}
    )
    surface_share: float = field(
        default=0.35,
        validator=_SHARE,
        metadata={"help": "layout nearest: probability that a vertex other than 0 is at the surface"},
    )
    depth: float = field(
        default=0.01, validator=_LENGTH, metadata={"help": "layout depths: how far the lower vertices lie down"}
    )
    edge_range: float = field(
        default=0.4, validator=_LENGTH, metadata={"help": "layout depths: length of the longest edges"}
    )
    edge_cost: EdgeCost = field(
        default="one", validator=in_(("one", "length")), metadata={"help": "what an edge costs: 1, or its length"}
    )
    speed: float = field(
        default=1.0,
        validator=_LENGTH,
        metadata={"help": "cost travelled in a step; an edge takes a whole number of steps, at least one"},
    )
    roadmaps: int = field(
        default=256,
        validator=[instance_of(int), ge(1), le(4096)],
        metadata={"help": "different roadmaps; scenario i uses roadmap i modulo this number"},
    )
    roadmap_seed: int = field(
        default=0, validator=_COUNT, metadata={"help": "seed of the roadmaps, which are the same in every run"}
    )
    start_x: float = field(default=0.05, validator=_SHARE, metadata={"help": "x of vertex 0, the start"})
    start_y: float = field(default=0.05, validator=_SHARE, metadata={"help": "y of vertex 0, the start"})
    drop_off_x: float = field(default=0.9, validator=_SHARE, metadata={"help": "x of vertex 1, the drop-off"})
    drop_off_y: float = field(default=0.9, validator=_SHARE, metadata={"help": "y of vertex 1, the drop-off"})
    comms_range: float = field(
        default=0.25, validator=_LENGTH, metadata={"help": "a surface vertex this close to vertex 0 is in comms"}
    )

    targets: int = field(default=8, validator=_COUNT, metadata={"help": "targets to report"})
    mines: int = field(default=8, validator=_COUNT, metadata={"help": "mines to disarm"})
    objects: int = field(default=5, validator=_COUNT, metadata={"help": "objects to deliver"})
    thing_share: float = field(
        default=0.0,
        validator=[ge(0.0), le(0.9)],
        metadata={
            "help": "probability that a vertex holds a thing, of each class alike and each at least once in a roadmap; "
            "0: as many as targets, mines and objects say"
        },
    )
    horizon: int = field(
        default=300, validator=[instance_of(int), ge(1), le(1_000_000)], metadata={"help": "steps of an episode"}
    )

    sensor: Sensor = field(
        default="detectors",
        validator=in_(("detectors", "classifier")),
        metadata={
            "help": "detectors: one per class, that detects or not, better from nearby; "
            "classifier: names the class, or nothing, alike from everywhere in range"
        },
    )
    sensor_range: float = field(
        default=0.15, validator=_LENGTH, metadata={"help": "the robot senses the vertices this close to it"}
    )
    sensor_accuracy: float = field(
        default=0.95,
        validator=[gt(0.25), lt(1.0)],
        metadata={"help": "classifier: probability of the right answer; the three wrong ones are alike"},
    )
    sensor_scale: float = field(
        default=0.08,
        validator=_LENGTH,
        metadata={"help": "detectors: distance at which the gain over false alarms has fallen to 1/e"},
    )
    target_pd: float = field(
        default=0.7, validator=_PROBABILITY, metadata={"help": "probability to detect a target at the robot's vertex"}
    )
    target_pf: float = field(
        default=0.1, validator=_PROBABILITY, metadata={"help": "probability to detect a target where there is none"}
    )
    mine_pd: float = field(
        default=0.95, validator=_PROBABILITY, metadata={"help": "probability to detect a mine at the robot's vertex"}
    )
    mine_pf: float = field(
        default=0.01, validator=_PROBABILITY, metadata={"help": "probability to detect a mine where there is none"}
    )
    object_pd: float = field(
        default=0.95, validator=_PROBABILITY, metadata={"help": "probability to detect an object at the robot's vertex"}
    )
    object_pf: float = field(
        default=0.01, validator=_PROBABILITY, metadata={"help": "probability to detect an object where there is none"}
    )

    target_found: float = field(
        default=0.98, validator=_PROBABILITY, metadata={"help": "a target is found above this belief"}
    )
    target_likely: float = field(
        default=0.3, validator=_PROBABILITY, metadata={"help": "a target is likely above this belief, until found"}
    )
    mine_found: float = field(
        default=0.8, validator=_PROBABILITY, metadata={"help": "a mine is found above this belief"}
    )
    object_found: float = field(
        default=0.8, validator=_PROBABILITY, metadata={"help": "an object is found above this belief"}
    )

    battery_low: float = field(
        default=0.0,
        validator=_BATTERY,
        metadata={"help": "cost travelled since the surface from which the battery is low; 0: never"},
    )
    battery_dead: float = field(
        default=0.0,
        validator=_BATTERY,
        metadata={
            "help": "cost travelled since the surface from which the battery is dead, and the robot lost; 0: never"
        },
    )
    extra_leaves: bool = field(
        default=False,
        validator=instance_of(bool),
        metadata={"help": "whether the robot has resurface, battery low and coverage as well"},
    )

    disarm_steps: int = field(default=4, validator=_STEPS, metadata={"help": "steps to disarm a mine"})
    pick_up_steps: int = field(default=2, validator=_STEPS, metadata={"help": "steps to pick up an object"})
    target_reward: float = field(default=10.0, validator=_REWARD, metadata={"help": "reward per target reported"})
    mine_reward: float = field(default=5.0, validator=_REWARD, metadata={"help": "reward per mine disarmed"})
    pick_up_reward: float = field(default=0.0, validator=_REWARD, metadata={"help": "reward per object picked up"})
    object_reward: float = field(default=10.0, validator=_REWARD, metadata={"help": "reward per object delivered"})

    def __init__(self, preset: PresetName = "default", **settings: object) -> None:
        # The generated __init__ does not tell what was given from what is a default, so the preset comes in here.
        values: dict[str, Any] = {**PRESETS.get(preset, {}), **settings}
        self.__attrs_init__(preset, **values)

    def __attrs_post_init__(self) -> None:
        things = 3 if self.thing_share else self.targets + self.mines + self.objects
        if things > self.vertices - 2:
            raise ValueError(
                f"'vertices' must be at least {things + 2}: {self.targets} targets, {self.mines} mines and "
                f"{self.objects} objects need a vertex each, besides the start and the drop-off"
            )
        if self.layout == "depths" and self.vertices % 2:
            raise ValueError(f"'vertices' must be even, not {self.vertices}: each point of layout depths has two")
