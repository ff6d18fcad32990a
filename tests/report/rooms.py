"""A world to look at: a robot in a row of rooms, which it should sweep; drawn, and with events."""

from grammarbt.bt import Status
from grammarbt.domain import ActionType, ConditionType, Group, Mark, Reference, TickDomain, Vocabulary

ROOMS = 6


class Rooms(TickDomain):
    vocabulary = Vocabulary((Group("clean", (ActionType("sweep"), ActionType("move")), (ConditionType("dirty"),)),))
    grammar = "general"
    references = (Reference("manual", "?( →( (dirty) [sweep] ) [move] )"),)
    box = (0.0, 0.0, float(ROOMS), 2.0)
    unit = "rooms"

    def reset(self, rng):
        self.dirt = [bool(dirty) for dirty in rng.random(ROOMS) < 0.6]
        self.at = self.time = 0
        self.told = []

    def condition(self, name):
        return self.dirt[self.at]

    def action(self, name):
        if name == "move":
            self.at = (self.at + 1) % ROOMS
            return Status.RUNNING
        swept, self.dirt[self.at] = self.dirt[self.at], False
        self.reward += swept
        self.told = [f"room {self.at} swept"] if swept else []
        return Status.SUCCESS if swept else Status.FAILURE

    def step(self):
        self.time += 1
        self.done = self.time == 20

    def picture(self):
        rooms = [
            Mark(f"room {at}", "square", "belief", at + 0.5, 0.5, 0.9, shade=0.8 if dirty else 0.1)
            for at, dirty in enumerate(self.dirt)
        ]
        return [*rooms, Mark("robot", "triangle", "robot", self.at + 0.5, 0.5, 0.5, label="robot")]

    def events(self):
        told, self.told = self.told, []
        return told


class Unseen:
    """The same rooms, in the dark."""

    def __init__(self):
        self.lit = Rooms()
        self.vocabulary, self.grammar = Rooms.vocabulary, Rooms.grammar
        self.references, self.depends_on = Rooms.references, Rooms.depends_on

    def simulate(self, policy, scenarios):
        return self.lit.simulate(policy, scenarios)
