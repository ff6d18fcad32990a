"""When a search stops: every rule of the spec, whichever holds first."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias

from attrs import Factory, define

from grammarbt.run.incumbent import Incumbent

if TYPE_CHECKING:
    from collections.abc import Callable

    from grammarbt.run.evaluate import Trial
    from grammarbt.run.spec import RunSpec

Reason: TypeAlias = Literal["budget", "trials", "target", "stagnation", "seconds", "exhausted", "stalled"]
"""Why a search stopped; exhausted: the searcher has nothing left, stalled: it proposes nothing new."""

_STALLED = 10_000


@define
class Tally:
    """What the stopping rules look at.

    Attributes:
        incumbent: the best tree so far.
        trials: proposals evaluated.
        episodes: episodes simulated.
        improved: how many had been simulated when the best tree was found.
        known_in_a_row: the last so many trials needed no simulation.
        bad: trials that were not `"ok"`, by status.
    """

    incumbent: Incumbent = Factory(Incumbent)
    trials: int = 0
    episodes: int = 0
    improved: int = 0
    known_in_a_row: int = 0
    bad: dict[str, int] = Factory(dict)

    def note(self, trial: Trial) -> None:
        """Count a trial."""
        evaluation = trial.evaluation
        self.trials += 1
        self.episodes += trial.simulated
        self.known_in_a_row = 0 if trial.simulated else self.known_in_a_row + 1
        if evaluation.status != "ok":
            self.bad[evaluation.status] = self.bad.get(evaluation.status, 0) + 1
        elif self.incumbent.consider(trial.text, trial.mean, trial.episodes, trial.fresh):
            self.improved = self.episodes


def reason_to_stop(spec: RunSpec, tally: Tally, out_of_time: Callable[[float], bool]) -> Reason | None:
    """The first rule that holds.

    Args:
        spec: the rules.
        tally: where the search stands.
        out_of_time: whether it has taken so many seconds.
    """
    if tally.episodes >= spec.search_episodes:
        return "budget"
    if spec.trials is not None and tally.trials >= spec.trials:
        return "trials"
    if spec.target is not None and tally.incumbent.mean >= spec.target:
        return "target"
    if spec.stagnation is not None and tally.episodes - tally.improved >= spec.stagnation:
        return "stagnation"
    if spec.seconds is not None and out_of_time(spec.seconds):
        return "seconds"
    return "stalled" if tally.known_in_a_row >= _STALLED else None
