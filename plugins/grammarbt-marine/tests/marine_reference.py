"""The marine simulator again, in readable plain Python: the compiled one must give the same numbers.

It walks the tree itself instead of its compiled policy. It shares the tables of roadmaps and rules with the compiled
simulator, so that both add the same floating-point numbers, and nothing else.
"""

import math

from grammarbt.bt import Action, Condition, Fallback, Not, Parallel, Sequence, Status, children, leaves

SUCCESS, FAILURE, RUNNING = Status.SUCCESS, Status.FAILURE, Status.RUNNING
TARGET, MINE, OBJECT = range(3)
PLACING, SENSING, WALKING = range(3)
START, DROP_OFF = 0, 1
SIXTY_FOUR_BITS = 2**64 - 1


class HorizonReachedError(Exception):
    pass


class PlainMarine:
    """Simulates trees on the roadmaps and rules of a `Marine` domain."""

    def __init__(self, domain):
        self.roadmaps = [Table(record) for record in domain.roadmaps]
        self.rules = Table(domain.rules[0])

    def simulate(self, tree, scenarios):
        """The returns of the episodes, and how often each leaf was ticked in all of them."""
        ticks = [0] * len(leaves(tree))
        returns = [self.episode(tree, int(scenario), ticks) for scenario in scenarios]
        return returns, ticks

    def episode(self, tree, scenario, ticks):
        robot = self.robot(scenario)
        try:
            while True:
                before = robot.step
                tick(tree, robot, ticks)
                if robot.step == before:
                    robot.pass_step()
        except HorizonReachedError:
            return robot.reward

    def robot(self, scenario):
        return Robot(self.roadmaps[scenario % len(self.roadmaps)], self.rules, scenario)


class Table:
    """A record's fields as attributes, its arrays as lists, which plain Python reads faster."""

    def __init__(self, record):
        for name in record.dtype.names:
            setattr(self, name, record[name].tolist())


def tick(node, robot, ticks, first=0):
    """Tick a node whose first leaf is the tree's leaf number `first`."""
    if isinstance(node, Action | Condition):
        ticks[first] += 1
        return robot.answer(node)
    if isinstance(node, Not):
        status = tick(node.child, robot, ticks, first)
        return {SUCCESS: FAILURE, FAILURE: SUCCESS}.get(status, status)
    statuses = []
    for child in children(node):
        statuses.append(tick(child, robot, ticks, first))
        result = decided(node, statuses)
        if result is not None:
            return result
        first += len(leaves(child))
    return {Fallback: FAILURE, Sequence: SUCCESS, Parallel: RUNNING}[type(node)]


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
    """A robot in its world; an action's method does one step of the action, a condition's method asks."""

    def __init__(self, roadmap, rules, scenario):
        vertices = len(roadmap.degree)
        self.roadmap, self.rules, self.key = roadmap, rules, mix(scenario)
        self.vertex, self.step, self.work, self.carrying, self.reward = START, 0, 0, False, 0.0
        self.content = self.placed_things(vertices)
        self.belief = [[prior] * vertices for prior in rules.prior]
        self.visited, self.reported, self.disarmed = {START}, set(), set()
        self.sense()

    def placed_things(self, vertices):
        free, content = list(range(DROP_OFF + 1, vertices)), {}
        kinds = [kind for kind in (TARGET, MINE, OBJECT) for _ in range(self.rules.count[kind])]
        for place, kind in enumerate(kinds):
            other = place + int(self.uniform(0, PLACING, place) * (len(free) - place))
            free[place], free[other] = free[other], free[place]
            content[free[place]] = kind
        return content

    def uniform(self, step, decides, item):
        return (mix(self.key + (decides << 48) + (step << 24) + item) >> 11) / 2**53

    def sense(self):
        here, roadmap = self.vertex, self.roadmap
        for place, vertex in enumerate(roadmap.in_range[here][: roadmap.reach[here]]):
            present = self.content.get(vertex)
            for kind in (TARGET, MINE, OBJECT):
                chance = roadmap.detection[here][place][kind] if present == kind else self.rules.false_alarm[kind]
                detected = self.uniform(self.step, SENSING, 3 * vertex + kind) < chance
                news = roadmap.gain if detected else roadmap.loss
                self.belief[kind][vertex] += news[here][place][kind]

    def pass_step(self):
        self.step += 1
        self.sense()
        if self.step >= self.rules.horizon:
            raise HorizonReachedError

    def answer(self, leaf):
        """Do one step of an action, or ask a condition; gives the status."""
        if isinstance(leaf, Condition):
            return SUCCESS if getattr(self, leaf.name.replace(" ", "_"))() else FAILURE
        if leaf.name == "go to comms" and self.in_comms():
            return SUCCESS
        status = getattr(self, leaf.name.replace(" ", "_"))()
        self.pass_step()
        return status

    def in_comms(self):
        return self.roadmap.comms[self.vertex]

    def at_surface(self):
        return self.roadmap.surface[self.vertex]

    def target_found(self):
        return bool(self.found_targets())

    def likely_target_found(self):
        return bool(self.likely_targets())

    def mine_found(self):
        return self.belief[MINE][self.vertex] > self.rules.found[MINE]

    def is_armed(self):
        return self.vertex not in self.disarmed

    def object_found(self):
        return self.carrying or self.belief[OBJECT][self.vertex] > self.rules.found[OBJECT]

    def carrying_object(self):
        return self.carrying

    def found_targets(self):
        certain = self.rules.found[TARGET]
        found = [vertex for vertex, belief in enumerate(self.belief[TARGET]) if belief > certain]
        return [vertex for vertex in found if vertex not in self.reported]

    def likely_targets(self):
        likely, certain = self.rules.likely, self.rules.found[TARGET]
        found = [vertex for vertex, belief in enumerate(self.belief[TARGET]) if likely < belief <= certain]
        return [vertex for vertex in found if vertex not in self.reported]

    def go_to_comms(self):
        return self.go_to_nearest([vertex for vertex, comms in enumerate(self.roadmap.comms) if comms])

    def go_to_likely_target(self):
        return self.go_to_nearest(self.likely_targets())

    def shortest_path(self):
        return self.go_to_nearest([vertex for vertex in range(len(self.roadmap.degree)) if vertex not in self.visited])

    def random_walk(self):
        edge = int(self.uniform(self.step, WALKING, 0) * self.roadmap.degree[self.vertex])
        self.move(self.roadmap.neighbours[self.vertex][edge])
        return RUNNING

    def report(self):
        if not self.in_comms():
            return FAILURE
        for vertex in self.found_targets():
            self.reported.add(vertex)
            if self.content.get(vertex) == TARGET:
                self.reward += self.rules.reward[TARGET]
        return SUCCESS

    def disarm(self):
        if self.vertex in self.disarmed:
            return SUCCESS
        status = self.work_on(MINE, self.rules.disarm_steps)
        if status == SUCCESS:
            self.disarmed.add(self.vertex)
            self.reward += self.rules.reward[MINE]
        return status

    def pick_up(self):
        if self.carrying:
            return FAILURE
        status = self.work_on(OBJECT, self.rules.pick_up_steps)
        if status == SUCCESS:
            self.carrying = True
            del self.content[self.vertex]
            self.belief[OBJECT][self.vertex] = -math.inf
        return status

    def take_to_drop_off(self):
        if not self.carrying:
            return FAILURE
        if self.vertex != DROP_OFF:
            return self.go_to_nearest([DROP_OFF])
        self.carrying = False
        self.reward += self.rules.reward[OBJECT]
        return SUCCESS

    def work_on(self, kind, steps):
        if self.content.get(self.vertex) != kind:
            self.belief[kind][self.vertex] = -math.inf
            return FAILURE
        self.work += 1
        return SUCCESS if self.work >= steps else RUNNING

    def go_to_nearest(self, goals):
        if not goals:
            return FAILURE
        goal = min(goals, key=self.roadmap.hops[self.vertex].__getitem__)  # the first, so the lowest, of the nearest
        self.move(self.roadmap.next_hop[self.vertex][goal])
        return RUNNING

    def move(self, vertex):
        if vertex != self.vertex:
            self.work = 0
        self.vertex = vertex
        self.visited.add(vertex)


def mix(number):
    number = (number + 1) * 0x9E3779B97F4A7C15 & SIXTY_FOUR_BITS
    number = (number ^ number >> 30) * 0xBF58476D1CE4E5B9 & SIXTY_FOUR_BITS
    number = (number ^ number >> 27) * 0x94D049BB133111EB & SIXTY_FOUR_BITS
    return number ^ number >> 31
