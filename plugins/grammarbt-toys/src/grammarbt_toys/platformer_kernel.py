"""A player runs through a level of gaps, walls and enemies, compiled.

The rules of time. A tick presses buttons, which never fails; then the world moves on by one step: the player rises or
falls one cell, goes one cell, or two when running, and shoots; last, every second step, the enemies walk. A jump lifts
the player for `RISE` steps. Who falls on an enemy beats it; who meets one otherwise, or falls into a gap, is out.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from grammarbt.domain import Scenarios
from grammarbt_toys.chance import uniform
from grammarbt_toys.program import FAILURE, SUCCESS, Program, cached, compiled, inlined

RIGHTS, UPS = (-1, 0, 1, 2, 3, 4), (-1, 0, 1, 2)
"""The receptive field: cells to the right of the player and above it."""
BUTTONS = ("left", "right", "run", "jump", "shoot")
LEAVES = (
    *BUTTONS,
    *("on ground", "can shoot"),
    *(f"solid(right={right},up={up})" for right in RIGHTS for up in UPS),
    *(f"enemy(right={right},up={up})" for right in RIGHTS for up in UPS),
)
"""What the kernel knows; a leaf's place here is its number in the vocabulary."""

LEFT, RIGHT, RUN, JUMP, SHOOT, ON_GROUND, CAN_SHOOT, SOLID = range(8)
ENEMY = SOLID + len(RIGHTS) * len(UPS)
X, Y, RISING, FACING, RELOADING = range(5)
"""Places in the player's state."""
GAP = -100
GONE, NO_MORE = -100, -200
RISE, RANGE, RELOAD = 2, 6, 6
FREE = 8
"""Columns without anything at both ends of the level."""


class World(NamedTuple):
    """A level of N columns.

    Attributes:
        ground: (N,) height of the ground; level ground has 0, a gap `GAP`.
        enemies: (N,) column of each enemy, the leftmost first, or `GONE`; after the last one `NO_MORE`.
        walking: (N,) the direction, -1 or 1, in which each walks.
        player: (5,) the player's column, height, steps still to rise, direction, and steps until it can shoot.
    """

    ground: NDArray[np.int64]
    enemies: NDArray[np.int64]
    walking: NDArray[np.int64]
    player: NDArray[np.int64]


@cached
def simulate(program: Program, world: World, steps: int, scenarios: Scenarios) -> NDArray[np.float64]:
    """Run an episode per scenario; gives the columns that the player came forward.

    Args:
        program: which buttons the player presses, over leaves as in `LEAVES`.
        world: overwritten.
        steps: how many steps an episode has at most.
        scenarios: (n,) what fixes the level.
    """
    returns = np.empty(scenarios.size)
    for index in range(scenarios.size):
        make_level(world, scenarios[index])
        returns[index] = play(program, world, steps)
    return returns


@compiled
def make_level(world: World, scenario: int) -> None:
    """Draw the level from left to right: gaps of 1 to 3 columns, walls 1 or 2 high, enemies, with space between."""
    world.ground[:] = 0
    world.enemies[:] = NO_MORE
    world.walking[:] = -1
    world.player[:] = 0
    world.player[FACING] = 1
    column, enemies = FREE, 0
    while column < len(world.ground) - FREE:
        kind, size = int(uniform(scenario, column, 0) * 3), int(uniform(scenario, column, 1) * 3)
        if kind == 0:
            world.ground[column : column + size + 1] = GAP
        elif kind == 1:
            world.ground[column] = min(size, 1) + 1
        else:
            world.enemies[enemies] = column
            enemies += 1
        column += size + 4 + int(uniform(scenario, column, 2) * 4)


@compiled
def play(program: Program, world: World, steps: int) -> int:
    """Play the level until the player is out, at the end, or the steps are over; gives the farthest column."""
    player, farthest = world.player, 0
    pressed = np.empty(len(BUTTONS), dtype=np.bool_)
    for step in range(1, steps + 1):
        pressed[:] = False
        _tick(program, world, pressed)
        alive = _move(world, pressed, step)
        farthest = max(farthest, player[X])
        if not alive or farthest == len(world.ground) - 1:
            break
    return farthest


@inlined
def _tick(program: Program, world: World, pressed: NDArray[np.bool_]) -> None:
    at = 0
    while at >= 0:
        leaf = program.leaf[at]
        program.ticks[program.occurrence[at]] += 1
        status = SUCCESS
        if leaf < ON_GROUND:
            pressed[leaf] = True
        elif not _holds(world, leaf):
            status = FAILURE
        at = program.follow[at, status]


@inlined
def _holds(world: World, condition: int) -> bool:
    x, y = world.player[X], world.player[Y]
    if condition == ON_GROUND:
        return _solid(world, x, y - 1)
    if condition == CAN_SHOOT:
        return bool(world.player[RELOADING] == 0)
    cell = condition - (ENEMY if condition >= ENEMY else SOLID)
    x += RIGHTS[cell // len(UPS)]
    y += UPS[cell % len(UPS)]
    return _enemy(world, x, y) >= 0 if condition >= ENEMY else _solid(world, x, y)


@inlined
def _solid(world: World, x: int, y: int) -> bool:
    """The level begins with a wall and ends without one."""
    return x < 0 or (x < len(world.ground) and bool(y < world.ground[x]))


@inlined
def _enemy(world: World, x: int, y: int) -> int:
    """The number of the first enemy in that cell, or -1."""
    number = 0
    while y == 0 and number < len(world.enemies) and world.enemies[number] != NO_MORE:
        if world.enemies[number] == x:
            return number
        number += 1
    return -1


@inlined
def _move(world: World, pressed: NDArray[np.bool_], step: int) -> bool:
    """Let a step pass; gives whether the player is still in the game."""
    _rise_or_fall(world, pressed[JUMP])
    alive = _go(world, pressed) and world.player[Y] >= 0
    _shoot(world, pressed[SHOOT])
    if step % 2 == 0:
        _walk(world)
    return alive and _enemy(world, world.player[X], world.player[Y]) < 0


@inlined
def _rise_or_fall(world: World, jump: bool) -> None:
    player = world.player
    on_ground = _solid(world, player[X], player[Y] - 1)
    if jump and on_ground:
        player[RISING] = RISE
    if player[RISING] > 0:
        player[RISING] -= 1
        player[Y] += 1
    elif not on_ground:
        player[Y] -= 1
        beaten = _enemy(world, player[X], player[Y])
        if beaten >= 0:
            world.enemies[beaten] = GONE


@inlined
def _go(world: World, pressed: NDArray[np.bool_]) -> bool:
    """Go along, up to the next wall; gives whether no enemy was met. Left and right together stand still."""
    player = world.player
    direction = int(pressed[RIGHT]) - int(pressed[LEFT])
    if direction != 0:
        player[FACING] = direction
    for _ in range(2 if pressed[RUN] else 1):
        ahead = player[X] + direction
        if ahead < len(world.ground) and not _solid(world, ahead, player[Y]):
            player[X] = ahead
        if _enemy(world, player[X], player[Y]) >= 0:
            return False
    return True


@inlined
def _shoot(world: World, shoot: bool) -> None:
    """Beat the nearest enemy in range that no wall hides."""
    player = world.player
    player[RELOADING] = max(player[RELOADING] - 1, 0)
    if not shoot or player[RELOADING] > 0:
        return
    player[RELOADING] = RELOAD
    for distance in range(1, RANGE + 1):
        x = player[X] + distance * player[FACING]
        beaten = _enemy(world, x, player[Y])
        if beaten >= 0:
            world.enemies[beaten] = GONE
        if beaten >= 0 or _solid(world, x, player[Y]):
            return


@inlined
def _walk(world: World) -> None:
    """Enemies walk one cell on level ground, or turn round where that ends."""
    for number in range(len(world.enemies)):
        if world.enemies[number] == NO_MORE:
            return
        if world.enemies[number] != GONE:
            ahead = world.enemies[number] + world.walking[number]
            if 0 <= ahead < len(world.ground) and world.ground[ahead] == 0:
                world.enemies[number] = ahead
            else:
                world.walking[number] *= -1
