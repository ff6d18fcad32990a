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
        self.inside, self.moisture = 18.0, 0.6

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
                    return FAILURE
                self.moisture += 0.2
        return RUNNING

    def quarter_of_an_hour(self, time):
        sun = max(0.0, -cos(2 * pi * time / TICKS)) * self.random.uniform(0.5, 1.5)
        self.inside += 0.05 * (self.outside - self.inside) + 1.2 * sun
        self.moisture -= 0.01 + 0.01 * sun
        return (15 <= self.inside <= 27) + (0.35 <= self.moisture <= 0.9)


def episode(request, scenario, ticks):
    """The return of one scenario; counts the ticks of each leaf."""
    world, reward = Greenhouse(scenario), 0.0
    policy, leaves = request["policy"], request["leaves"]
    for time in range(TICKS):
        at = 0
        while at >= 0:  # one tick: a negative number ends it
            _, occurrence, on_success, on_failure, on_running = policy[5 * at : 5 * at + 5]
            ticks[occurrence] += 1
            status = world.answer(leaves[occurrence])
            at = {SUCCESS: on_success, FAILURE: on_failure, RUNNING: on_running}[status]
        reward += world.quarter_of_an_hour(time)
    return reward


def main():
    print(json.dumps(ANNOUNCEMENT), flush=True)
    for line in sys.stdin:
        request = json.loads(line)
        ticks = [0] * len(request["leaves"])
        returns = [episode(request, scenario, ticks) for scenario in request["scenarios"]]
        print(json.dumps({"id": request["id"], "returns": returns, "ticks": ticks}), flush=True)


if __name__ == "__main__":
    main()
