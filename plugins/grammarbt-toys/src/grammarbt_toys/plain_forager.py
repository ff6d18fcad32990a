"""A robot of the swarm in plain Python: what it remembers, and what its leaves do."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from grammarbt.bt import Condition, Leaf, Status
from grammarbt.domain import Mark
from grammarbt_toys.foraging_kernel import TURNING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from grammarbt_toys.plain_foraging import PlainForaging

SUCCESS, FAILURE, RUNNING = Status.SUCCESS, Status.FAILURE, Status.RUNNING
DIRECTIONS = [(down, right) for down in (-1, 0, 1) for right in (-1, 0, 1) if (down, right) != (0, 0)]

Cell: TypeAlias = tuple[int, int]


def distance(one: Cell, other: Cell) -> int:
    """In moves; a diagonal one counts once."""
    return max(abs(one[0] - other[0]), abs(one[1] - other[1]))


class Forager:
    """An action's method does one step of the action, a condition's method asks."""

    def __init__(self, world: PlainForaging, number: int, place: Cell, heading: Cell) -> None:
        self.world, self.number, self.place, self.heading = world, number, place, heading
        self.carrying, self.moved, self._acted = False, False, False
        self.known: dict[str, Cell] = {}

    def begin_turn(self) -> None:
        """It may move once, and looks around."""
        self.moved = self._acted = False
        self._look()

    def answer(self, leaf: Leaf) -> Status:
        """Do one step of an action, or ask a condition; after an action it looks again."""
        if self._acted:
            self._look()
        answer = getattr(self, "_" + leaf.name.replace(" ", "_"))(*(value for _, value in leaf.arguments))
        if isinstance(leaf, Condition):
            return SUCCESS if answer else FAILURE
        self._acted = True
        return Status(answer)

    def mark(self, y: int) -> Mark:
        """The robot in the picture."""
        return Mark(f"robot {self.number + 1}", "circle", "robot", self.place[1], y, 0.8, 1.0, "*" * self.carrying)

    def _sees(self, cell: Cell) -> bool:
        return distance(self.place, cell) <= self.world.parameters.sight

    def _look(self) -> None:
        """Remember the hub and sites in sight; forget a site seen empty, and food out of sight."""
        if self._sees(self.world.hub):
            self.known["hub"] = self.world.hub
        for site in filter(self._sees, self.world.sites):
            if self.world.has_food(site):
                self.known["site"] = site
            elif self.known.get("site") == site:
                del self.known["site"]
        seen = [cell for cell in self._cells("food") if self._sees(cell)]
        self.known.pop("food", None)
        if seen:
            self.known["food"] = min(seen, key=lambda cell: (distance(self.place, cell), cell))

    def _cells(self, thing: str) -> Iterable[Cell]:
        if thing == "hub":
            return (self.world.hub,)
        return self.world.sites if thing == "site" else filter(self.world.has_food, self.world.food)

    def _near(self, thing: str, cells: int) -> bool:
        return any(distance(self.place, cell) <= cells for cell in self._cells(thing))

    def _carrying(self, _: str) -> bool:
        return self.carrying

    def _neighbour(self, thing: str) -> bool:
        return self._near(thing, self.world.parameters.sight)

    def _droppable(self, thing: str) -> bool:
        return self.carrying and self._near(thing, 1)

    def _visited_before(self, thing: str) -> bool:
        return thing in self.known

    def _pick_up(self) -> Status:
        if self.carrying or not self._near("food", 1):
            return FAILURE
        self.world.take_food(self.known["food"])
        self.carrying = True
        self._say("picked up")
        return SUCCESS

    def _drop(self) -> Status:
        if not self.carrying:
            return FAILURE
        self.carrying = False
        if self._near("hub", 1):
            self.world.delivered += 1
            self._say("delivered")
        else:
            self.world.add_food(self.place)
            self._say("dropped")
        return SUCCESS

    def _explore(self) -> Status:
        """Go straight on, now and then along a new direction; a wall turns the robot back."""
        if not self.moved:
            if self.world.chance(2 * self.number) < TURNING:
                self.heading = DIRECTIONS[int(self.world.chance(2 * self.number + 1) * len(DIRECTIONS))]
            down, right = (self._turned_back(axis) for axis in (0, 1))
            self.heading = (down, right)
            self._move(down, right)
        return RUNNING

    def _turned_back(self, axis: int) -> int:
        step = self.heading[axis]
        return step if 0 <= self.place[axis] + step < self.world.parameters.size else -step

    def _move_towards(self, thing: str) -> Status:
        return FAILURE if self.known.get(thing) == self.place else self._go(thing, 1)

    def _move_away(self, thing: str) -> Status:
        return self._go(thing, -1)

    def _go(self, thing: str, sign: int) -> Status:
        if thing not in self.known:
            return FAILURE
        if not self.moved:
            (row, column), (goal_row, goal_column) = self.place, self.known[thing]
            self._move(sign * _sign(goal_row - row), sign * _sign(goal_column - column))
        return RUNNING

    def _move(self, down: int, right: int) -> None:
        most = self.world.parameters.size - 1
        self.moved = True
        self.place = min(max(self.place[0] + down, 0), most), min(max(self.place[1] + right, 0), most)

    def _say(self, what: str) -> None:
        self.world.news.append(f"robot {self.number + 1}: food {what}")


def _sign(number: int) -> int:
    return (number > 0) - (number < 0)
