"""A robot in plain Python: what it senses, and what its leaves do; the rules are told in `kernel`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from grammarbt.bt import Action, Leaf, Status
from grammarbt.domain.chance import uniform
from grammarbt_marine.kernel.sensing import LEAST_BELIEF
from grammarbt_marine.layouts import DROP_OFF, START
from grammarbt_marine.state import MINE, NOTHING, OBJECT, TARGET

if TYPE_CHECKING:
    from grammarbt.bt import FlatTree
    from grammarbt_marine.plain import PlainEpisode, Watcher

SUCCESS, FAILURE, RUNNING = Status.SUCCESS, Status.FAILURE, Status.RUNNING
PLACING, SENSING, WALKING = range(3)
_FREE = frozenset({"go to comms", "resurface"})
"""Actions that take no step when they succeed."""


class PlainRobot:
    """A robot; an action's method does one step of the action, a condition's method asks."""

    def __init__(self, sea: PlainEpisode, number: int) -> None:
        self.sea, self.roadmap, self.rules, self.number = sea, sea.roadmap, sea.rules, number
        self.key = sea.key + (number << 56)
        self.entry, self.vertex, self.under_way, self.travelled, self.work = -1, START, 0, 0.0, 0
        self.carrying = False
        self.events: list[str] = []
        self.belief = [[prior] * len(sea.roadmap.degree) for prior in sea.rules.prior]
        self.visited, self.told = {START}, set[int]()

    @property
    def dead(self) -> bool:
        """Whether its battery is."""
        return bool(self.travelled >= self.rules.battery_dead)

    def take_step(self, flat: FlatTree, watcher: Watcher) -> None:
        """Go on with its tick, and then with the next one, until something takes a step."""
        if self.under_way > 0:
            self.under_way -= 1
            return
        idle = self.entry < 0
        while not self.dead:
            entry = flat.entries[flat.entry if self.entry < 0 else self.entry]
            status = self.answer(entry.leaf)
            watcher.answered(self, entry.occurrence, status)
            self.entry = {SUCCESS: entry.on_success, FAILURE: entry.on_failure, RUNNING: entry.on_running}[status]
            if takes_step(entry.leaf, status) or (self.entry < 0 and idle):
                return
            if self.entry < 0:
                watcher.ended(self)
                idle = True

    def chance(self, decides: int, item: int) -> float:
        """A number from 0 to below 1 for one decision of this step."""
        return uniform(self.key + (decides << 48) + (self.sea.step << 24) + item)

    def sense(self) -> None:
        """Unless it is under way or lost, look around; in comms, learn what was reported."""
        if self.under_way > 0 or self.dead:
            return
        for place, vertex in enumerate(self.roadmap.in_range[self.vertex][: self.roadmap.reach[self.vertex]]):
            if self.rules.classifies:
                self._classify(vertex)
            else:
                self._detect(place, vertex)
        if self._in_comms():
            self.told |= self.sea.reported

    def _detect(self, place: int, vertex: int) -> None:
        here, roadmap = self.vertex, self.roadmap
        present = self.sea.content.get(vertex)
        for kind in (TARGET, MINE, OBJECT):
            chance = roadmap.detection[here][place][kind] if present == kind else self.rules.false_alarm[kind]
            detected = self.chance(SENSING, 3 * vertex + kind) < chance
            news = roadmap.gain if detected else roadmap.loss
            self.belief[kind][vertex] += news[here][place][kind]

    def _classify(self, vertex: int) -> None:
        right, wrong = self.rules.right, self.rules.wrong
        truth = self.sea.content.get(vertex, NOTHING)
        beyond = self.chance(SENSING, 3 * vertex) - right
        reading = (truth + (0 if beyond < 0 else 1 + int(beyond / wrong) % 3)) % 4
        weights = [row[vertex] * (right if kind == reading else wrong) for kind, row in enumerate(self.belief)]
        total = 0.0
        for weight in weights:  # one after the other: sum() would round otherwise
            total += weight
        for row, weight in zip(self.belief, weights, strict=True):
            row[vertex] = max(weight / total, LEAST_BELIEF)

    def answer(self, leaf: Leaf) -> Status:
        """Do one step of an action, or ask a condition."""
        answer = getattr(self, "_" + leaf.name.replace(" ", "_"))()
        if isinstance(leaf, Action):
            return Status(answer)
        return SUCCESS if answer else FAILURE

    def _in_comms(self) -> bool:
        return bool(self.roadmap.comms[self.vertex])

    def _at_surface(self) -> bool:
        return bool(self.roadmap.surface[self.vertex])

    def _target_found(self) -> bool:
        return bool(self._found_targets())

    def _likely_target_found(self) -> bool:
        return bool(self._likely_targets())

    def _mine_found(self) -> bool:
        return bool(self.belief[MINE][self.vertex] > self.rules.found[MINE])

    def _is_armed(self) -> bool:
        return self.vertex not in self.sea.disarmed

    def _object_found(self) -> bool:
        return self.carrying or bool(self.belief[OBJECT][self.vertex] > self.rules.found[OBJECT])

    def _carrying_object(self) -> bool:
        return self.carrying

    def _battery_low(self) -> bool:
        return bool(self.travelled >= self.rules.battery_low)

    def _go_to_comms(self) -> Status:
        return SUCCESS if self._in_comms() else self._go_to_nearest(_flagged(self.roadmap.comms))

    def _resurface(self) -> Status:
        return SUCCESS if self._at_surface() else self._go_to_nearest(_flagged(self.roadmap.surface))

    def _go_to_likely_target(self) -> Status:
        return self._go_to_nearest(self._likely_targets())

    def _shortest_path(self) -> Status:
        return self._go_to_nearest([vertex for vertex in range(len(self.belief[0])) if vertex not in self.visited])

    def _coverage(self) -> Status:
        return self._go_to_nearest([vertex for vertex in self.roadmap.sweep if vertex not in self.visited][:1])

    def _random_walk(self) -> Status:
        edge = int(self.chance(WALKING, 0) * self.roadmap.degree[self.vertex])
        self._move(self.roadmap.neighbours[self.vertex][edge])
        return RUNNING

    def _report(self) -> Status:
        if not self._in_comms():
            return FAILURE
        for vertex in self._found_targets():
            if self.sea.content.get(vertex) != TARGET:
                self._say("false report")
            elif vertex not in self.sea.reported:
                self._win(self.rules.reward[TARGET], "target reported")
            self.told.add(vertex)
            self.sea.reported.add(vertex)
        return SUCCESS

    def _disarm(self) -> Status:
        if self.vertex in self.sea.disarmed:
            return SUCCESS
        status = self._work_on(MINE, self.rules.disarm_steps)
        if status is SUCCESS:
            self.sea.disarmed.add(self.vertex)
            self._win(self.rules.reward[MINE], "mine disarmed")
        return status

    def _pick_up(self) -> Status:
        if self.carrying:
            return FAILURE
        status = self._work_on(OBJECT, self.rules.pick_up_steps)
        if status is SUCCESS:
            self.carrying = True
            self.belief[OBJECT][self.vertex] = self.rules.impossible
            del self.sea.content[self.vertex]
            self._win(self.rules.pick_up_reward, "object picked up")
        return status

    def _take_to_drop_off(self) -> Status:
        if not self.carrying:
            return FAILURE
        if self.vertex != DROP_OFF:
            return self._go_to_nearest([DROP_OFF])
        self.carrying = False
        self._win(self.rules.reward[OBJECT], "object delivered")
        return SUCCESS

    def _found_targets(self) -> list[int]:
        certain = self.rules.found[TARGET]
        found = [vertex for vertex, belief in enumerate(self.belief[TARGET]) if belief > certain]
        return [vertex for vertex in found if vertex not in self.told]

    def _likely_targets(self) -> list[int]:
        likely, certain = self.rules.likely, self.rules.found[TARGET]
        found = [vertex for vertex, belief in enumerate(self.belief[TARGET]) if likely < belief <= certain]
        return [vertex for vertex in found if vertex not in self.told]

    def _work_on(self, kind: int, steps: int) -> Status:
        if self.sea.content.get(self.vertex) != kind:
            self.belief[kind][self.vertex] = self.rules.impossible
            return FAILURE
        self.work += 1
        return SUCCESS if self.work >= steps else RUNNING

    def _go_to_nearest(self, goals: Sequence[int]) -> Status:
        if not goals:
            return FAILURE
        # min gives the first of the nearest, and so the lowest
        goal = min(goals, key=self.roadmap.distance[self.vertex].__getitem__)
        self._move(self.roadmap.next_hop[self.vertex][goal])
        return RUNNING

    def _move(self, vertex: int) -> None:
        if vertex == self.vertex:
            return
        cost = self.roadmap.distance[self.vertex][vertex]
        self.under_way = max(math.ceil(cost / self.rules.speed) - 1, 0)
        self.vertex, self.work = vertex, 0
        self.visited.add(vertex)
        self.travelled += cost
        if self.dead:
            self._say("battery dead")
        elif self._at_surface():
            self.travelled = 0.0

    def _win(self, reward: float, what: str) -> None:
        self.sea.reward += reward
        self._say(what)

    def _say(self, what: str) -> None:
        self.events.append(what if len(self.sea.robots) == 1 else f"robot {self.number + 1}: {what}")


def takes_step(leaf: Leaf, status: Status) -> bool:
    """Whether a leaf that answered so has taken a step."""
    return isinstance(leaf, Action) and not (status is SUCCESS and leaf.name in _FREE)


def _flagged(flags: Sequence[int]) -> list[int]:
    return [vertex for vertex, flag in enumerate(flags) if flag]
