"""An episode as a program tells it, whole and spoilt."""

import json
import sys
from pathlib import Path

from grammarbt.bt import compile_policy, parse
from grammarbt_exec.domain import make_exec
from grammarbt_exec.parameters import ExecParameters

TREE = "?( →( (near) [stay] ) [go(to=home)] )"
"""Its leaves are numbered 0, 1 and 2."""

MARK = {"name": "robot", "shape": "circle", "role": "robot", "x": 1, "y": 2.5, "size": 1}
GOAL = MARK | {"name": "goal", "role": "goal", "x": 3}
EPISODE = {
    "box": [0, 0, 4, 3],
    "unit": "steps",
    "marks": [MARK, GOAL],
    "frames": [
        {"answers": [[0, "failure"], [2, "running"]], "reward": -1, "changes": [MARK | {"x": 2}, GOAL]},
        {"answers": [[0, "success"], [1, "success"]], "reward": 9.5, "events": ["home"]},
    ],
}


def line(episode):
    """An answer that tells it."""
    return '{"id":ID,' + json.dumps(episode)[1:]


def altered(path, value):
    """The episode with something else in one place, or something more at the end of a list."""
    episode, place, last = _at(path)
    if isinstance(place, list) and last == len(place):
        place.append(value)
    else:
        place[last] = value
    return episode


def without(path):
    """The episode with nothing in one place."""
    episode, place, last = _at(path)
    del place[last]
    return episode


def _at(path):
    """A copy of the episode, and what holds the place in it, and as what."""
    episode = place = json.loads(json.dumps(EPISODE))
    *way, last = path
    for key in way:
        place = place[key]
    return episode, place, last


class Teller:
    """A program that answers every request with a text, and the episode that this tells."""

    def __init__(self, folder):
        self.answer = folder / "answer"
        self.command = f"{sys.executable} {Path(__file__).with_name('teller.py')} {self.answer}"
        self._domain = make_exec(ExecParameters(self.command))
        self._policy = compile_policy(parse(TREE), self._domain.vocabulary.index)

    def __call__(self, text):
        self.answer.write_text(text, encoding="utf-8")
        return self._domain.episode(self._policy, 0)

    def close(self):
        self._domain.close()
