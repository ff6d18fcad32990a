"""A greenhouse: keep it warm, not hot, and the soil moist, for a day and a night. It needs Python, and no package.

grammarbt run --domain exec --set domain.command="python3 docs/examples/exec/greenhouse.py"
"""

import json
import random
import sys
from math import cos, pi

FAILURE, SUCCESS, RUNNING = "failure", "success", "running"
TICKS = 96  # a quarter of an hour each

ANNOUNCEMENT = {
    "protocol": 1,
    "episodes": True,
    "grammar": "scheide",
    "groups": [
        {
            "name": "air",
            "actions": [
                {"name": "heat", "help": "Heat for a quarter of an hour.", "results": ["running"]},
                {"name": "open window", "help": "Let some air from outside in.", "results": ["running"]},
            ],
            "conditions": [
                {"name": "cold", "help": "It is colder than 16 degrees.", "pure": True},
                {"name": "hot", "help": "It is hotter than 26 degrees.", "pure": True},
            ],
        },
        {
            "name": "soil",
            "actions": [{"name": "water", "help": "Needs the pump, which fails now and then."}],
            "conditions": [{"name": "dry", "help": "The soil is less than 40 % moist.", "pure": True}],
        },
        {"name": "rest", "actions": [{"name": "wait", "help": "Do nothing.", "results": ["running"]}]},
    ],
    "references": [
        {"name": "manual", "tree": "?( →( (dry) [water] ) →( (cold) [heat] ) →( (hot) [open window] ) [wait] )"}
    ],
}


class Greenhouse:
    def __init__(self, scenario):
        self.random = random.Random(scenario)  # the same weather for every tree
        self.outside = self.random.uniform(2, 14)
        self.inside, self.moisture, self.sun = 18.0, 0.6, 0.0
        self.events = []

    def answer(self, leaf):
        match leaf:
            case "(cold)":
                return SUCCESS if self.inside < 16 else FAILURE
            case "(hot)":
                return SUCCESS if self.inside > 26 else FAILURE
            case "(dry)":
                return SUCCESS if self.moisture < 0.4 else FAILURE
            case "[heat]":
                self.inside += 1.5
            case "[open window]":
                self.inside += 0.3 * (self.outside - self.inside)
            case "[water]":
                if self.random.random() < 0.3:
                    self.events.append("the pump fails")
                    return FAILURE
                self.moisture += 0.2
        return RUNNING

    def quarter_of_an_hour(self, time):
        self.sun = max(0.0, -cos(2 * pi * time / TICKS)) * self.random.uniform(0.5, 1.5)
        self.inside += 0.05 * (self.outside - self.inside) + 1.2 * self.sun
        self.moisture -= 0.01 + 0.01 * self.sun
        return (15 <= self.inside <= 27) + (0.35 <= self.moisture <= 0.9)

    def picture(self):
        """The sun, and two gauges, each with the range it shall keep to."""
        air = f"{self.inside:.1f} °C, outside {self.outside:.1f} °C"
        return [
            {"name": "sun", "shape": "circle", "role": "object", "x": 5, "y": 9, "size": 1, "shade": self.sun / 1.5},
            *gauge("air", 3, self.inside / 5, (3, 5.4), air),
            *gauge("soil", 7, self.moisture * 7, (2.45, 6.3), f"{self.moisture:.0%} moist"),
        ]


def gauge(name, x, height, wanted, label):
    low, high = wanted
    scale = {"shape": "line", "x": x, "to_x": x, "size": 0.3}
    return [
        {"name": f"{name} scale", "role": "ground", "y": 0, "to_y": 8, **scale},
        {"name": f"{name} wanted", "role": "goal", "y": low, "to_y": high, **scale},
        {"name": name, "shape": "circle", "role": "robot", "x": x, "y": height, "size": 0.6, "label": label},
    ]


def ticks(request, scenario):
    """Plays a scenario: gives the world, what the leaves answered, and the return so far after each tick."""
    world, reward = Greenhouse(scenario), 0.0
    policy, leaves = request["policy"], request["leaves"]
    for time in range(TICKS):
        at, answers, world.events = 0, [], []
        while at >= 0:  # one tick: a negative number ends it
            _, occurrence, on_success, on_failure, on_running = policy[5 * at : 5 * at + 5]
            status = world.answer(leaves[occurrence])
            answers.append((occurrence, status))
            at = {SUCCESS: on_success, FAILURE: on_failure, RUNNING: on_running}[status]
        reward += world.quarter_of_an_hour(time)
        yield world, answers, reward


def simulation(request):
    """The return of each scenario, and how often each leaf was ticked."""
    returns, counts = [], [0] * len(request["leaves"])
    for scenario in request["scenarios"]:
        returns.append(0.0)
        for _, answers, reward in ticks(request, scenario):
            returns[-1] = reward
            for occurrence, _ in answers:
                counts[occurrence] += 1
    return {"returns": returns, "ticks": counts}


def episode(request):
    """One scenario to watch."""
    scenario = request["episode"]
    frames = [
        {"answers": answers, "reward": reward, "changes": world.picture(), "events": world.events}
        for world, answers, reward in ticks(request, scenario)
    ]
    return {"frames": frames, "marks": Greenhouse(scenario).picture(), "box": [0, 0, 10, 10], "unit": "comfort"}


def main():
    print(json.dumps(ANNOUNCEMENT), flush=True)
    for line in sys.stdin:
        request = json.loads(line)
        answer = episode(request) if "episode" in request else simulation(request)
        print(json.dumps({"id": request["id"], **answer}), flush=True)


if __name__ == "__main__":
    main()
