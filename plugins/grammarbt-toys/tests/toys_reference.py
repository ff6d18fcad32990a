"""The toy worlds again, in readable plain Python: the compiled ones must give the same numbers."""

from itertools import product
from math import prod

from grammarbt.bt import Action, Condition, Fallback, Not, Parallel, Sequence, Status, flatten, tick
from grammarbt.bt import leaves as leaves_of


def answer_of(holds):
    return Status.SUCCESS if holds else Status.FAILURE


class EpisodeOverError(Exception):
    pass


def plain_taskselection(tree, last):
    """The return, how often each leaf was ticked, and by assignment (c0 to c`last`) the first action."""
    ticks, chosen = [0] * len(leaves_of(tree)), {}
    for truth in product((False, True), repeat=last + 1):
        acted = []

        def answer(leaf, occurrence, truth=truth, acted=acted):
            ticks[occurrence] += 1
            if isinstance(leaf, Condition):
                return answer_of(truth[int(leaf.name[1:])])
            acted.append(leaf.name)
            return Status.RUNNING

        tick(flatten(tree), answer)
        chosen[truth] = acted[0] if acted else None
    right = sum(action == plain_right_action(truth) for truth, action in chosen.items())
    return right / len(chosen), ticks, chosen


def plain_right_action(truth):
    return "a0" if truth[0] else f"a{prod(number for number, holds in enumerate(truth) if holds)}"


class PlainAnt:
    """An ant on a trail drawn as text; what it does is written down, a letter a step, in capitals where it ate."""

    def __init__(self, rows, steps):
        self.rows, self.columns = len(rows), len(rows[0])
        self.food = {(row, column) for row, line in enumerate(rows) for column, sign in enumerate(line) if sign == "#"}
        self.place, self.heading, self.steps, self.written = (0, 0), (0, 1), steps, ""

    def play(self, tree):
        """What was written down, and how often each leaf was ticked."""
        ticks = [0] * len(leaves_of(tree))

        def answer(leaf, occurrence):
            if len(self.written) == self.steps:
                raise EpisodeOverError
            ticks[occurrence] += 1
            return self.answer(leaf)

        try:
            while len(self.written) < self.steps:
                before = self.written
                tick(flatten(tree), answer)
                self.written += "." if self.written == before else ""
        except EpisodeOverError:
            pass
        return self.written, ticks

    def answer(self, leaf):
        down, right = self.heading
        ahead = (self.place[0] + down) % self.rows, (self.place[1] + right) % self.columns
        if leaf.name == "food ahead":
            return answer_of(ahead in self.food)
        if leaf.name == "move forward":
            self.place = ahead
            self.written += "M" if ahead in self.food else "m"
            self.food.discard(ahead)
        else:
            self.heading = (right, -down) if leaf.name == "turn right" else (-right, down)
            self.written += leaf.name.removeprefix("turn ")[0]
        return Status.SUCCESS

    def eaten(self):
        return self.written.count("M")


def wild_tree(rng, leaves, size):
    """Any nesting of all kinds of nodes."""
    if size <= 1:
        return leaves[rng.integers(len(leaves))]
    if rng.random() < 0.15:
        return Not(wild_tree(rng, leaves, size - 1))
    parts = tuple(wild_tree(rng, leaves, rng.integers(1, max(2, size // 2))) for _ in range(rng.integers(2, 5)))
    if rng.random() < 0.15:
        return Parallel(parts, rng.integers(1, len(parts), endpoint=True))
    return (Fallback, Sequence)[rng.integers(2)](parts)


def kinds_of(nodes):
    return {type(node) for node in nodes}


EVERY_KIND = {Action, Condition, Fallback, Not, Parallel, Sequence}
SIXTY_FOUR_BITS = 2**64 - 1


def mix(number):
    number = (number + 1) * 0x9E3779B97F4A7C15 & SIXTY_FOUR_BITS
    number = (number ^ number >> 30) * 0xBF58476D1CE4E5B9 & SIXTY_FOUR_BITS
    number = (number ^ number >> 27) * 0x94D049BB133111EB & SIXTY_FOUR_BITS
    return number ^ number >> 31
