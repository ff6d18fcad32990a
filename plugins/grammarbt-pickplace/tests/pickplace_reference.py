"""The pick and place simulator again, in readable plain Python: the compiled one must give the same numbers.

It walks the tree itself instead of its compiled policy, has its own numbers, and shares only the tasks.
"""

import math
from dataclasses import dataclass, field

from grammarbt.bt import Action, Condition, Fallback, Not, Parallel, Sequence, Status, children, leaves, walk

SUCCESS, FAILURE, RUNNING = Status.SUCCESS, Status.FAILURE, Status.RUNNING
FRESH = None
POSES = {
    "spawn": (2.4, -11.0),
    "pick0": (-1.148, -6.1),
    "pick1": (-2.32, -10.52),
    "pick2": (-0.54, -0.545),
    "place": (2.6009, -1.7615),
}
FACING = {"spawn": (0, 1), "pick0": (0, -1), "pick1": (0, -1), "pick2": (-1, 0), "place": (1, 0), "elsewhere": (1, 0)}
GOAL = (3.1509, -1.7615, 0.8625)
SIXTY_FOUR_BITS = 2**64 - 1


class PlainPickPlace:
    """Simulates trees in a task."""

    def __init__(self, task, *, stochastic=False):
        self.task, self.stochastic = task, stochastic

    def simulate(self, tree, scenarios):
        """The returns of the episodes, and how often each leaf was ticked in all of them."""
        ticks = [0] * len(leaves(tree))
        return [self.episode(tree, int(scenario), ticks) for scenario in scenarios], ticks

    def episode(self, tree, scenario, ticks):
        runs = []
        for number in range(len(self.task.starts)):
            run = self.run(tree, scenario, number)
            run.play(tree)
            runs.append(run.robot.score(sum(1 for _ in walk(tree))))
            for leaf, count in enumerate(run.ticks):
                ticks[leaf] += count
        return sum(runs) / len(runs)

    def run(self, tree, scenario, number):
        robot = Robot(self.task.starts[number], mix(scenario) + (number << 48), self.stochastic)
        return Run(robot, [Memory() for _ in leaves(tree)], [0] * len(leaves(tree)))


@dataclass
class Memory:
    status: Status | None = FRESH
    was_running: int = -1


@dataclass
class Run:
    """One robot obeying one tree; `log` has a line for each tick and, indented, one for what was done in it."""

    robot: "Robot"
    memories: list[Memory]
    ticks: list[int]
    tick_number: int = 0
    log: list[str] = field(default_factory=list)

    def play(self, tree):
        results = []
        while len(results) < 60 and results.count(FAILURE) < 5 and results[-2:] != [SUCCESS, SUCCESS]:
            self.tick_number += 1
            before = len(self.log)
            results.append(self.tick(tree))
            self.log.insert(before, f"tick {self.tick_number}: the tree answers {results[-1].name}")

    def tick(self, node, first=0):
        """Tick a node whose first leaf is the tree's leaf number `first`."""
        if isinstance(node, Action | Condition):
            self.ticks[first] += 1
            return self.leaf(node, self.memories[first])
        if isinstance(node, Not):
            status = self.tick(node.child, first)
            return {SUCCESS: FAILURE, FAILURE: SUCCESS}.get(status, status)
        statuses = []
        for child in children(node):
            statuses.append(self.tick(child, first))
            result = decided(node, statuses)
            if result is not None:
                return result
            first += len(leaves(child))
        return {Fallback: FAILURE, Sequence: SUCCESS, Parallel: RUNNING}[type(node)]

    def leaf(self, leaf, memory):
        if isinstance(leaf, Condition):
            return SUCCESS if self.robot.holds(leaf.name) else FAILURE
        if memory.was_running != self.tick_number - 1 and not self.robot.in_effect(leaf.name):
            memory.status = FRESH
        if memory.status is FRESH:
            self.robot.begin(leaf.name)
            memory.status = RUNNING
        elif memory.status is RUNNING:
            memory.status = SUCCESS if self.robot.act(leaf.name) else FAILURE
            self.log.append(f"  [{leaf.name}] {memory.status.name}: {self.robot.describe()}")
        if memory.status is RUNNING:
            memory.was_running = self.tick_number
        return memory.status


def decided(node, statuses):
    """What a control node answers after these answers of its children, or None to go on."""
    if isinstance(node, Fallback):
        return statuses[-1] if statuses[-1] != FAILURE else None
    if isinstance(node, Sequence):
        return statuses[-1] if statuses[-1] != SUCCESS else None
    if statuses.count(SUCCESS) >= node.successes:
        return SUCCESS
    return FAILURE if statuses.count(FAILURE) > len(node.children) - node.successes else None


class Robot:
    """The robot and the cubes."""

    def __init__(self, starts, key, stochastic):
        self.starts, self.key, self.stochastic = starts, key, stochastic
        self.acts, self.time = 0, 0.0
        self.place, self.pose, self.estimate = "spawn", POSES["spawn"], (-0.03343, -0.0321)
        self.localised, self.head, self.arm, self.held, self.visited = False, "down", "stretched", None, set()
        self.moving = self.handling = False
        self.cubes = list(starts)
        self.measure()

    def describe(self):
        known = "localised" if self.localised else "lost"
        held = "nothing" if self.held is None else f"cube {self.held}"
        return f"at {self.place}, {known}, head {self.head}, arm {self.arm}, holding {held}"

    def score(self, nodes):
        to_goal, to_robot = sum(self.to_goal), sum(self.to_robot)
        cost = 0.5 * nodes + 0.1 * self.time
        cost += 10.0 * to_goal * to_goal + self.error * self.error + 2.0 * to_robot * to_robot
        placed = self.to_goal.count(0.0)
        if placed < len(self.cubes):
            cost += 300.0 - 100.0 * placed - (0.0 if self.held is None else 50.0)
        return -cost

    def holds(self, condition):
        if condition == "have block":
            return self.held is not None
        if condition == "task done":
            return sum(self.to_goal) == 0.0
        if condition.startswith("table"):
            return f"pick{condition[5]}" in self.visited
        return self.cubes[int(condition[4])] == GOAL and self.held is None

    def in_effect(self, action):
        if action.startswith("move to "):
            return self.place == action.removeprefix("move to ")
        return {
            "tuck": self.arm == "tucked",
            "pick": self.held is not None,
            "place": self.held is None,
            "localise": self.localised,
            "head up": self.head == "up" or self.handling,
            "head down": self.head == "down" or self.moving,
        }[action]

    def begin(self, action, *, at_work=True):
        if action.startswith("move to "):
            self.moving = at_work
        elif action in ("tuck", "pick", "place"):
            self.handling = at_work

    def act(self, action):
        self.begin(action, at_work=False)
        self.acts += 1
        if action in ("head up", "head down"):
            self.time += 2.0
            self.head = action.removeprefix("head ")
            return True
        if action.startswith("move to "):
            success = self.move(action.removeprefix("move to "))
        else:
            self.time += {"tuck": 3.0, "pick": 12.0, "place": 5.0, "localise": 7.0}[action]
            success = {"tuck": self.tuck, "pick": self.pick, "place": self.put, "localise": self.localise}[action]()
        self.update()
        return success

    def localise(self):
        self.localised = not self.goes_wrong(5, 0.2)
        return self.localised

    def tuck(self):
        self.arm = "tucked"
        self.lose_cube()
        return True

    def move(self, place):
        before = self.estimate
        if self.place != place and self.localised and self.head == "up" and self.arm in ("tucked", "at pick"):
            self.drive(place)
        self.time += length(self.pose[0] - before[0], self.pose[1] - before[1]) / 0.3
        return self.place == place

    def drive(self, place):
        dropped = self.held is not None and self.goes_wrong(6, 0.05)
        lost = self.goes_wrong(7, 0.1)
        goal = POSES[place]
        if dropped or lost:
            self.place = "elsewhere"
            self.pose = tuple((here + there) / 2.0 for here, there in zip(self.estimate, goal, strict=True))
        else:
            self.place, self.pose = place, goal
        if dropped:
            self.lose_cube()
        if lost:
            self.localised = False
            self.estimate = tuple(here + 0.1 * self.uniform(8 + axis) for axis, here in enumerate(self.pose))

    def pick(self):
        nearest = self.to_robot.index(min(self.to_robot))
        ready = self.localised and self.head == "down" and self.arm == "tucked"
        at_table = self.place in ("pick0", "pick1", "pick2", "place")
        success = ready and at_table and self.to_robot[nearest] < 0.8 and not self.goes_wrong(5, 0.2)
        if success:
            self.held, self.arm = nearest, "at pick"
        if self.place.startswith("pick"):
            self.visited.add(self.place)
        return success

    def put(self):
        ready = self.held is not None and self.localised and self.head == "down"
        if not ready or self.place != "place" or self.arm != "at pick" or self.goes_wrong(5, 0.1):
            return False
        self.cubes[self.held], self.held, self.arm = GOAL, None, "at place"
        return True

    def lose_cube(self):
        if self.held is not None:
            self.cubes[self.held], self.held = self.starts[self.held], None

    def update(self):
        noise = [self.uniform(axis) for axis in range(2)]
        if self.localised:
            self.estimate = tuple(here + 0.1 * more for here, more in zip(self.pose, noise, strict=True))
        else:
            self.estimate = tuple(here + 1.5 + more for here, more in zip(self.estimate, noise, strict=True))
        if self.held is not None:
            x, y = (
                here + 0.3 * ahead + (0.2 * self.uniform(2 + axis) - 0.1)
                for axis, (here, ahead) in enumerate(zip(self.pose, FACING[self.place], strict=True))
            )
            self.cubes[self.held] = (x, y, 1.3 + 0.1 * self.uniform(4))
        self.measure()

    def measure(self):
        self.error = length(*(there - here for there, here in zip(self.estimate, self.pose, strict=True)))
        self.to_goal = [length(*(one - goal for one, goal in zip(cube, GOAL, strict=True))) for cube in self.cubes]
        self.to_robot = [length(cube[0] - self.pose[0], cube[1] - self.pose[1]) for cube in self.cubes]

    def goes_wrong(self, decides, probability):
        return self.stochastic and self.uniform(decides) < probability

    def uniform(self, decides):
        return (mix(self.key + (self.acts << 16) + decides) >> 11) / 2**53


def length(x, y, z=0.0):
    return math.sqrt(x * x + y * y + z * z)


def mix(number):
    number = (number + 1) * 0x9E3779B97F4A7C15 & SIXTY_FOUR_BITS
    number = (number ^ number >> 30) * 0xBF58476D1CE4E5B9 & SIXTY_FOUR_BITS
    number = (number ^ number >> 27) * 0x94D049BB133111EB & SIXTY_FOUR_BITS
    return number ^ number >> 31
