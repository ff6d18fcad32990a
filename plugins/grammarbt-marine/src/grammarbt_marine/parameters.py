"""The numbers of the marine domain; the defaults are calibrated so that every group of leaves matters.

Lengths are in units of the square sea area's side, times in steps, rewards in points.
"""

from __future__ import annotations

from attrs import field, frozen
from attrs.validators import ge, gt, instance_of, le, lt

_COUNT = [instance_of(int), ge(0)]
_PROBABILITY = [gt(0.0), lt(1.0)]  # a certain sensor would make the log odds infinite
_SHARE = [ge(0.0), le(1.0)]
_LENGTH = [gt(0.0), le(10.0)]
_REWARD = [ge(-1e6), le(1e6)]


@frozen
class MarineParameters:
    """Parameters of the marine domain.

    Raises:
        ValueError: a number is out of range, or the things to place outnumber the vertices.
    """

    vertices: int = field(
        default=80,
        validator=[instance_of(int), ge(3), le(500)],
        metadata={"help": "vertices of a roadmap, with the start and the drop-off"},
    )
    neighbours: int = field(
        default=4,
        validator=[instance_of(int), ge(1)],
        metadata={"help": "nearest vertices that each vertex is joined to"},
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
    surface_share: float = field(
        default=0.35, validator=_SHARE, metadata={"help": "probability that a vertex other than 0 is at the surface"}
    )
    comms_range: float = field(
        default=0.25, validator=_LENGTH, metadata={"help": "a surface vertex this close to vertex 0 is in comms"}
    )

    targets: int = field(default=8, validator=_COUNT, metadata={"help": "targets to report"})
    mines: int = field(default=8, validator=_COUNT, metadata={"help": "mines to disarm"})
    objects: int = field(default=5, validator=_COUNT, metadata={"help": "objects to deliver"})
    horizon: int = field(
        default=300,
        validator=[instance_of(int), ge(1), le(1_000_000)],
        metadata={"help": "steps of an episode"},
    )

    sensor_range: float = field(
        default=0.15, validator=_LENGTH, metadata={"help": "the robot senses the vertices this close to it"}
    )
    sensor_scale: float = field(
        default=0.08,
        validator=_LENGTH,
        metadata={"help": "distance at which the gain of the sensor over false alarms has fallen to 1/e"},
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

    disarm_steps: int = field(
        default=4, validator=[instance_of(int), ge(1)], metadata={"help": "steps to disarm a mine"}
    )
    pick_up_steps: int = field(
        default=2, validator=[instance_of(int), ge(1)], metadata={"help": "steps to pick up an object"}
    )
    target_reward: float = field(default=10.0, validator=_REWARD, metadata={"help": "reward per target reported"})
    mine_reward: float = field(default=5.0, validator=_REWARD, metadata={"help": "reward per mine disarmed"})
    object_reward: float = field(default=10.0, validator=_REWARD, metadata={"help": "reward per object delivered"})

    def __attrs_post_init__(self) -> None:
        things = self.targets + self.mines + self.objects
        if things > self.vertices - 2:
            raise ValueError(
                f"'vertices' must be at least {things + 2}: {self.targets} targets, {self.mines} mines and "
                f"{self.objects} objects need a vertex each, besides the start and the drop-off"
            )
