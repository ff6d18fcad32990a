"""The foraging world again, in readable plain Python, with drawings of what happens."""

from toys_reference import SIXTY_FOUR_BITS, answer_of, mix

from grammarbt.bt import Condition, Status, flatten, leaves, tick

SUCCESS, FAILURE, RUNNING = Status.SUCCESS, Status.FAILURE, Status.RUNNING
DIRECTIONS = [(down, right) for down in (-1, 0, 1) for right in (-1, 0, 1) if (down, right) != (0, 0)]


def distance(one, other):
    return max(abs(one[0] - other[0]), abs(one[1] - other[1]))


class PlainForaging:
    """One episode; `delivered` counts the food at the hub."""

    def __init__(self, parameters, scenario):
        self.parameters, self.scenario, self.step, self.delivered = parameters, scenario, 0, 0
        self.hub, self.item = (parameters.size // 2, parameters.size // 2), 2**20
        self.robots = [Robot(self, number) for number in range(parameters.robots)]
        self.sites = [self.drawn_cell(parameters.size // 4) for _ in range(parameters.sites)]
        self.food = [site for site in self.sites for _ in range(parameters.food)]

    def uniform(self, item):
        return (mix(mix(self.scenario) + (self.step << 24) + item & SIXTY_FOUR_BITS) >> 11) / 2**53

    def drawn_cell(self, least):
        while True:
            cell = tuple(int(self.uniform(self.item + axis) * self.parameters.size) for axis in (0, 1))
            self.item += 2
            if distance(cell, self.hub) >= least:
                return cell

    def play(self, tree):
        """How often each leaf was ticked."""
        ticks = [0] * len(leaves(tree))
        for _ in range(self.parameters.steps):
            self.pass_step(tree, ticks)
        return ticks

    def pass_step(self, tree, ticks):
        self.step += 1
        for robot in self.robots:
            robot.look()
            robot.moved = False

            def answer(leaf, occurrence, robot=robot):
                ticks[occurrence] += 1
                return robot.answer(leaf)

            tick(flatten(tree), answer)

    def drawing(self):
        """Hub H, sites S, food *, a robot r, or R with food; the rows as one text."""
        signs = {self.hub: "H", **dict.fromkeys(self.sites, "S"), **dict.fromkeys(self.food, "*")}
        signs.update({robot.place: "R" if robot.carrying else "r" for robot in self.robots})
        side = range(self.parameters.size)
        return ["".join(signs.get((row, column), ".") for column in side) for row in side]


class Robot:
    def __init__(self, world, number):
        self.world, self.number, self.carrying, self.moved = world, number, False, False
        self.place, self.heading = world.drawn_cell(0), DIRECTIONS[int(world.uniform(number) * 8)]
        self.known = {}

    def sees(self, cell):
        return distance(self.place, cell) <= self.world.parameters.sight

    def look(self):
        if self.sees(self.world.hub):
            self.known["hub"] = self.world.hub
        for site in filter(self.sees, self.world.sites):
            if site in self.world.food:
                self.known["site"] = site
            elif self.known.get("site") == site:
                del self.known["site"]
        seen = sorted(filter(self.sees, self.world.food), key=lambda cell: (distance(self.place, cell), cell))
        self.known.pop("food", None)
        if seen:
            self.known["food"] = seen[0]

    def answer(self, leaf):
        things = dict(leaf.arguments).values()
        method = self.carrying_one if leaf.name == "carrying" else getattr(self, leaf.name.replace(" ", "_"))
        if isinstance(leaf, Condition):
            return answer_of(method(*things))
        status = method(*things)
        self.look()
        return status

    def near(self, thing, cells):
        cells_of = {"hub": [self.world.hub], "site": self.world.sites, "food": self.world.food}
        return any(distance(self.place, cell) <= cells for cell in cells_of[thing])

    def carrying_one(self, thing):
        return self.carrying

    def neighbour(self, thing):
        return self.near(thing, self.world.parameters.sight)

    def droppable(self, thing):
        return self.carrying and self.near(thing, 1)

    def visited_before(self, thing):
        return thing in self.known

    def pick_up(self):
        if self.carrying or not self.near("food", 1):
            return FAILURE
        self.world.food.remove(self.known["food"])
        self.carrying = True
        return SUCCESS

    def drop(self):
        if not self.carrying:
            return FAILURE
        if self.near("hub", 1):
            self.world.delivered += 1
        else:
            self.world.food.append(self.place)
        self.carrying = False
        return SUCCESS

    def explore(self):
        if not self.moved:
            if self.world.uniform(2 * self.number) < 0.1:
                self.heading = DIRECTIONS[int(self.world.uniform(2 * self.number + 1) * 8)]
            self.heading = tuple(
                step if 0 <= at + step < self.world.parameters.size else -step
                for at, step in zip(self.place, self.heading, strict=True)
            )
            self.move(self.heading)
        return RUNNING

    def move_towards(self, thing):
        return FAILURE if self.known.get(thing) == self.place else self.go(thing, 1)

    def move_away(self, thing):
        return self.go(thing, -1)

    def go(self, thing, sign):
        if thing not in self.known:
            return FAILURE
        if not self.moved:
            goal = zip(self.place, self.known[thing], strict=True)
            self.move([sign * ((there > here) - (there < here)) for here, there in goal])
        return RUNNING

    def move(self, steps):
        most = self.world.parameters.size - 1
        self.moved = True
        self.place = tuple(min(max(at + step, 0), most) for at, step in zip(self.place, steps, strict=True))
