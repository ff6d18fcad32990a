"""Recording an episode of the plain simulator, to be watched."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grammarbt.bt import Status, flatten
from grammarbt.domain import Drawing, Episode, Frame
from grammarbt_marine.picture import BOX, Picture
from grammarbt_marine.plain import PlainMarine

if TYPE_CHECKING:
    from grammarbt.bt import BehaviorTree
    from grammarbt_marine.domain import Marine
    from grammarbt_marine.plain import PlainEpisode
    from grammarbt_marine.plain_robot import PlainRobot


def record(domain: Marine, tree: BehaviorTree, scenario: int) -> Episode:
    """The episode of a scenario; in a team each robot's tick is a frame of its own, in the order in which they end."""
    sea = PlainMarine(domain).episode(scenario)
    recorder = _Recorder(sea, Picture(domain.parameters, sea))
    sea.run(flatten(tree), recorder)
    return Episode(tuple(recorder.frames), recorder.marks, BOX, "points")


class _Recorder:
    """Makes a frame of every tick that ends."""

    def __init__(self, sea: PlainEpisode, picture: Picture) -> None:
        self.marks = (*picture.ground(), *picture.now())
        self.frames: list[Frame] = []
        self._sea, self._picture, self._drawing = sea, picture, Drawing(self.marks)
        self._answers: list[list[tuple[int, Status]]] = [[] for _ in sea.robots]

    def answered(self, robot: PlainRobot, occurrence: int, status: Status) -> None:
        self._answers[robot.number].append((occurrence, status))

    def ended(self, robot: PlainRobot) -> None:
        answers = self._answers[robot.number]
        if answers:
            changes = self._drawing.changes(self._picture.now())
            self.frames.append(Frame(tuple(answers), self._sea.reward, changes, tuple(robot.events)))
            answers.clear()
            robot.events.clear()
