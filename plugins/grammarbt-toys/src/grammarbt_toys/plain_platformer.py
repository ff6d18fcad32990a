"""The platform game in plain Python: to compare with, and to watch; the rules are told in `platformer_kernel.py`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import pi

from grammarbt.bt import Action, Leaf, Status
from grammarbt.domain import Mark
from grammarbt.domain.chance import mix, uniform
from grammarbt_toys.platformer_kernel import FREE, RANGE, RELOAD, RISE

BEHIND, AHEAD, TOP = 6, 17, 3
"""Columns that the picture shows behind and ahead of the player, and rows above level ground."""


def draw_level(scenario: int, columns: int) -> str:
    """The level as a row of signs: `_` level ground, a blank a gap, 1 and 2 walls, `e` an enemy."""
    signs, column = ["_"] * columns, FREE
    while column < columns - FREE:
        kind, size, space = (int(_chance(scenario, column, item) * count) for item, count in enumerate((3, 3, 4)))
        thing = (" " * (size + 1), "12"[min(size, 1)], "e")[kind]
        signs[column : column + len(thing)] = thing
        column += size + 4 + space
    return "".join(signs)


def _chance(scenario: int, column: int, item: int) -> float:
    return uniform(mix(scenario) + (column << 24) + item)


class PlainGame:
    """One episode in a level given as a row of signs."""

    box = (-BEHIND - 1.0, -2.0, AHEAD + 1.0, TOP + 2.0)

    def __init__(self, level: str, steps: int) -> None:
        self.ground = [int(sign) if sign in "12" else None if sign == " " else 0 for sign in level]
        self.enemies = [[column, -1] for column, sign in enumerate(level) if sign == "e"]
        self.x, self.y, self.rising, self.facing, self.reloading, self.alive = 0, 0, 0, 1, 0, True
        self.time, self.steps, self.farthest = 0, steps, 0
        self.pressed: set[str] = set()
        self._shown = list(self.enemies)
        self._news: list[str] = []

    @property
    def reward(self) -> float:
        """The farthest column so far."""
        return float(self.farthest)

    @property
    def done(self) -> bool:
        """Whether the player is out, at the end of the level, or out of time."""
        return not self.alive or self.time == self.steps or self.farthest == len(self.ground) - 1

    def answer(self, leaf: Leaf, _: int) -> Status:
        """Press a button, or ask a condition."""
        if isinstance(leaf, Action):
            self.pressed.add(leaf.name)
            return Status.SUCCESS
        cell = {key: int(value) for key, value in leaf.arguments}
        holds: bool = getattr(self, leaf.name.replace(" ", "_"))(**cell)
        return Status.SUCCESS if holds else Status.FAILURE

    def step(self, _: Status | None) -> None:
        """Let a step pass."""
        self.time += 1
        self._rise_or_fall()
        self._go()
        self._shoot()
        self._walk()
        self.farthest = max(self.farthest, self.x)
        self.pressed.clear()

    def solid(self, right: int, up: int) -> bool:
        """Whether the cell is ground or wall; the level begins with a wall and ends without one."""
        x, y = self.x + right, self.y + up
        if not 0 <= x < len(self.ground):
            return x < 0
        height = self.ground[x]
        return height is not None and y < height

    def enemy(self, right: int, up: int) -> bool:
        """Whether the cell holds an enemy."""
        return self.y + up == 0 and any(column == self.x + right for column, _ in self.enemies)

    def on_ground(self) -> bool:
        """Whether the player stands."""
        return self.solid(0, -1)

    def can_shoot(self) -> bool:
        """Whether the weapon is loaded."""
        return self.reloading == 0

    def events(self) -> Sequence[str]:
        """Enemies beaten, and how the game ended."""
        news, self._news = self._news, []
        if not self.alive:
            news.append("fell into a gap" if self.y < 0 else "met an enemy")
        elif self.farthest == len(self.ground) - 1:
            news.append("at the end of the level")
        return news

    def picture(self) -> Sequence[Mark]:
        """The level around the player, who stays where it is in the picture."""
        cells = (mark for right in range(-BEHIND, AHEAD + 1) for mark in self._column(right))
        player = Mark("player", "triangle", "robot", 0.0, self.y, 0.9, angle=0.0 if self.facing > 0 else pi)
        return (
            *cells,
            *self._foes(),
            player,
            Mark("note", "text", "note", 0.0, TOP + 1.0, 0.6, label=f"column {self.x}"),
        )

    def _beat(self, right: int) -> None:
        """Only the first of several enemies in one cell is beaten."""
        if self.enemy(right, 0):
            self.enemies.remove(next(enemy for enemy in self.enemies if enemy[0] == self.x + right))
            self._news.append("enemy beaten")

    def _rise_or_fall(self) -> None:
        on_ground = self.on_ground()
        if "jump" in self.pressed and on_ground:
            self.rising = RISE
        if self.rising:
            self.rising -= 1
            self.y += 1
        elif not on_ground:
            self.y -= 1
            self._beat(0)

    def _go(self) -> None:
        direction = ("right" in self.pressed) - ("left" in self.pressed)
        self.facing = direction or self.facing
        for _ in range(2 if "run" in self.pressed else 1):
            if self.alive and not self.solid(direction, 0) and self.x + direction < len(self.ground):
                self.x += direction
            self.alive = self.alive and not self.enemy(0, 0)
        self.alive = self.alive and self.y >= 0

    def _shoot(self) -> None:
        """Beat the nearest enemy in range that no wall hides."""
        self.reloading = max(0, self.reloading - 1)
        if "shoot" not in self.pressed or self.reloading:
            return
        self.reloading = RELOAD
        for right in range(self.facing, (RANGE + 1) * self.facing, self.facing):
            if self.enemy(right, 0):
                self._beat(right)
                return
            if self.solid(right, 0):
                return

    def _walk(self) -> None:
        """Every second step enemies walk one cell, or turn round where the level ground ends."""
        for enemy in self.enemies if self.time % 2 == 0 else ():
            ahead = enemy[0] + enemy[1]
            if 0 <= ahead < len(self.ground) and self.ground[ahead] == 0:
                enemy[0] = ahead
            else:
                enemy[1] *= -1
        self.alive = self.alive and not self.enemy(0, 0)

    def _column(self, right: int) -> Iterator[Mark]:
        """The ground and two cells for a wall; what is not there cannot be seen."""
        column = self.x + right
        height = self.ground[column] if 0 <= column < len(self.ground) else 2 if column < 0 else 0
        top = -1 if height is None else height
        yield Mark(f"ground {right}", "square", "hazard" if height is None else "ground", right, -1.0, 1.0)
        for row in range(2):
            yield Mark(f"wall {right},{row}", "square", "ground", right, row, 1.0, float(row < top))

    def _foes(self) -> Iterator[Mark]:
        for number, enemy in enumerate(self._shown):
            seen = any(enemy is other for other in self.enemies) and -BEHIND <= enemy[0] - self.x <= AHEAD
            right = enemy[0] - self.x if seen else 0
            yield Mark(f"enemy {number + 1}", "triangle", "hazard", right, 0.0, 0.8, float(seen), angle=pi / 2)
