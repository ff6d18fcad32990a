"""What people call the actions and observations of well-known environments."""

from __future__ import annotations

from enum import EnumMeta
from typing import TYPE_CHECKING

from attrs import frozen

if TYPE_CHECKING:
    from grammarbt_gymnasium.environment import Environment


@frozen
class Known:
    """Names of an environment, in its own order.

    Attributes:
        actions: one per action.
        features: one per number of the observation.
        ordered: whether discrete observations count something, so that more or less of them means something.
    """

    actions: tuple[str, ...]
    features: tuple[str, ...] = ()
    ordered: bool = False


KNOWN = {
    "CartPole": Known(("push left", "push right"), ("cart position", "cart velocity", "pole angle", "pole velocity")),
    "MountainCar": Known(("push left", "do nothing", "push right"), ("position", "velocity")),
    "Acrobot": Known(
        ("torque left", "no torque", "torque right"), ("cos 1", "sin 1", "cos 2", "sin 2", "velocity 1", "velocity 2")
    ),
    "LunarLander": Known(
        ("do nothing", "fire left engine", "fire main engine", "fire right engine"),
        ("x", "y", "x velocity", "y velocity", "angle", "turning", "left leg", "right leg"),
    ),
    "FrozenLake": Known(("go left", "go down", "go right", "go up")),
    "CliffWalking": Known(("go up", "go right", "go down", "go left")),
    "Taxi": Known(("go south", "go north", "go east", "go west", "pick up", "drop off")),
    "Blackjack": Known(("stick", "hit"), ("player sum", "dealer card", "usable ace"), ordered=True),
}

MINIGRID = {"left": "turn left", "right": "turn right", "forward": "move forward", "pickup": "pick up"}
"""Words for the names in MiniGrid's enumeration of actions."""

NOTHING = ("do nothing", "no torque", "noop", "done")
"""Names of actions that let the world go on; `done` of MiniGrid does."""


def action_names(environment: Environment) -> tuple[str, ...]:
    """What the actions are called, one name each.

    From `KNOWN`, else from the environment itself; where that gives no name for each, `action 0`, `action 1` and so on.
    """
    n = int(environment.actions.n)
    known = KNOWN.get(environment.name)
    found = known.actions if known else _own_names(environment)
    return found if len(set(found)) == n else tuple(f"action {number}" for number in range(n))


def _own_names(environment: Environment) -> tuple[str, ...]:
    """Atari games say their actions' meanings, MiniGrid has an enumeration of them."""
    world = environment.env.unwrapped
    if hasattr(world, "get_action_meanings"):
        return tuple(str(meaning).lower() for meaning in world.get_action_meanings())
    own = getattr(world, "actions", None)
    if not isinstance(own, EnumMeta):
        return ()
    names = [str(name) for name in own.__members__]
    return tuple(MINIGRID.get(name, name) for name in names)
