"""Named sets of parameters: what each preset changes of the defaults."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, TypeAlias

PresetName: TypeAlias = Literal["default", "sparse", "scheide"]
Settings: TypeAlias = Mapping[str, int | float | bool | str]

PRESETS: dict[PresetName, Settings] = {
    "default": {},
    # The sparse rewards that the paper's discussion calls difficult to learn from: few things in the same sea.
    "sparse": {"targets": 2, "mines": 2, "objects": 1},
    # The parameters that the authors published with their simulator, lengths divided by the side of their area, 1000.
    "scheide": {
        "vertices": 100,
        "layout": "depths",
        "depth": 0.01,
        "edge_range": 0.4,
        "edge_cost": "length",
        "speed": 0.2,
        "start_x": 0.0,
        "start_y": 0.0,
        "comms_range": 0.7,
        "thing_share": 0.1,
        "sensor": "classifier",
        "sensor_range": 0.1,
        "sensor_accuracy": 0.95,
        "target_found": 0.75,
        "mine_found": 0.75,
        "object_found": 0.75,
        "battery_low": 0.5,
        "battery_dead": 1.0,
        "extra_leaves": True,
        "disarm_steps": 1,
        "pick_up_steps": 1,
        "target_reward": 3.0,
        "mine_reward": 3.0,
        "pick_up_reward": 3.0,
        "object_reward": 2.0,
        "horizon": 200,
    },
}
"""By name the parameters whose defaults a preset replaces."""
