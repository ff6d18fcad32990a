"""A run from beginning to end: search, select, validate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, cast

from attrs import asdict, field, frozen

from grammarbt.bt import format_tree, parse
from grammarbt.errors import RunError, SearcherError
from grammarbt.plugins.events import RunFinished, RunStarted, TrialFinished
from grammarbt.run.ablate import Ablator
from grammarbt.run.evaluate import Evaluator, Trial
from grammarbt.run.folder import RunFolder, create_folder
from grammarbt.run.journal import Journal
from grammarbt.run.loop import AskTellLoop, guarded
from grammarbt.run.record import Recorder
from grammarbt.run.replay import Replay
from grammarbt.run.score import Score, Validator
from grammarbt.run.select import MAX_CANDIDATES, SuccessiveHalving
from grammarbt.run.simulator import make_simulator
from grammarbt.run.snapshot import Camera, Snapshot, restore
from grammarbt.run.stopping import Tally

if TYPE_CHECKING:
    from grammarbt.bt import BehaviorTree
    from grammarbt.run.setup import Setup
    from grammarbt.run.watch import Watcher

_ABLATION_EPISODES = 500
"""Scenarios per tree on which `complete` is decided, at most."""


@frozen
class Named:
    """A score and whose it is."""

    name: str
    value: float
    stderr: float


@frozen
class Result:
    """What `grammarbt run --json` prints; the fields are those of the documented JSON.

    Attributes:
        failed: how many trials of the search had which status other than `"ok"`.
    """

    run: str
    tree: str
    value: float
    stderr: float
    episodes: int
    trials: int
    seconds: float
    reference: Named | None
    ratio: float | None
    complete: bool | None
    stopped: str
    validation: int
    failed: Mapping[str, int]


def execute(setup: Setup, watcher: Watcher) -> Result:
    """Make the run's folder and run.

    Raises:
        GrammarBTError: the folder cannot be used, the searcher broke, or every trial failed.
        KeyboardInterrupt: the user stopped it; the journal is whole up to the last batch, and the best tree saved.
    """
    folder = create_folder(setup.spec, setup.resolved)
    return go_on(setup, folder, Past(Journal.open(folder.journal)), watcher)


@frozen(eq=False)
class Past:
    """What a run goes on from.

    Attributes:
        journal: open, at the snapshot's position if there is one.
        replay: the journal's trials from there on.
        snapshot: where the search begins; None for the very beginning.
    """

    journal: Journal
    replay: Replay = field(factory=Replay)
    snapshot: Snapshot | None = None


def go_on(setup: Setup, folder: RunFolder, past: Past, watcher: Watcher) -> Result:
    """Run in a folder, from where its journal ends; closes the journal.

    Raises:
        RunError: what is in the journal does not happen again.
        GrammarBTError: as `execute`.
        KeyboardInterrupt: as `execute`.
    """
    watcher.folder(folder.path)
    with Recorder(folder, past.journal, past.snapshot.batches if past.snapshot else 0) as recorder, setup.executor:
        return _Run(setup, folder, recorder, past, watcher).run()


class _Run:
    def __init__(self, setup: Setup, folder: RunFolder, recorder: Recorder, past: Past, watcher: Watcher) -> None:
        self.setup, self.spec = setup, setup.spec
        self.folder, self.recorder, self.watcher = folder, recorder, watcher
        self.simulator = make_simulator(setup.domain, setup.executor, self.spec.workers)
        self.evaluator = Evaluator(setup.domain, self.spec.seed, past.replay, self.simulator)
        self.tally = restore(past.snapshot, setup, self.evaluator) if past.snapshot else Tally()
        self.camera = Camera(folder, setup, self.evaluator, recorder, self.tally)

    def run(self) -> Result:
        spec = self.spec
        parameters = {part: dict(spec.settings(part)) for part in ("searcher", "domain")}
        self.watcher.notify(
            RunStarted(self.folder.path, spec.domain, spec.searcher, spec.seed, spec.budget, parameters)
        )
        outcome: dict[str, object] = {"run": str(self.folder.path), "stopped": "failed"}
        try:
            result = self.phases()
            outcome = asdict(result)
        except KeyboardInterrupt:
            outcome["stopped"] = "interrupted"
            raise
        finally:
            self.watcher.notify(RunFinished(self.folder.path, outcome))
        return result

    def phases(self) -> Result:
        stopped = self.search()
        best = self.select()
        self.folder.save_best(best)
        return self.result(best, stopped)

    def search(self) -> str:
        self.watcher.phase("searching", self.spec.search_episodes - self.tally.episodes)
        try:
            reason = AskTellLoop(self.setup.searcher, self.evaluator, self.spec, self.tally, self).run()
        finally:
            if self.tally.incumbent.tree is not None:
                self.folder.save_best(self.tally.incumbent.tree)
        self.recorder.event(event="searched", stopped=reason, trials=self.tally.trials, episodes=self.tally.episodes)
        return reason

    @property
    def seconds(self) -> float:
        return self.recorder.seconds

    def learned(self) -> None:
        self.camera.shoot()

    def evaluated(self, trials: Sequence[Trial]) -> None:
        self.recorder.batch(trials)
        metrics = self.recorder.metrics = guarded("metrics", self.setup.searcher.metrics)
        first = self.tally.trials - len(trials) + 1
        for number, trial in enumerate(trials, first):
            self.watcher.advance(trial.simulated)
            self.watcher.notify(self.trial_finished(number, trial, metrics))

    def trial_finished(self, number: int, trial: Trial, metrics: Mapping[str, float]) -> TrialFinished:
        evaluation, best = trial.evaluation, self.tally.incumbent
        return TrialFinished(
            self.folder.path,
            number,
            self.tally.episodes,
            trial.text,
            evaluation.status,
            evaluation.mean,
            best.mean,
            best.text,
            metrics,
        )

    def select(self) -> BehaviorTree:
        incumbent = self.tally.incumbent.tree
        if incumbent is None:
            raise RunError("no tree could be evaluated", f"the errors stand in {self.folder.journal}")
        self.watcher.phase("selecting", self.spec.selection_episodes)
        candidates = guarded("candidates", lambda: self.setup.searcher.candidates(MAX_CANDIDATES))
        if not isinstance(cast("object", candidates), Sequence) or len(candidates) > MAX_CANDIDATES:
            raise SearcherError("candidates must return a list of trees, no more than asked for", "best first")
        if incumbent not in candidates:  # a searcher that was stopped in the middle may not have been told of it
            candidates = [*candidates[: MAX_CANDIDATES - 1], incumbent]
        return SuccessiveHalving(self.evaluator, self.record_selection).best(candidates, self.spec.selection_episodes)

    def record_selection(self, trial: Trial) -> None:
        self.recorder.selection(trial)
        self.watcher.advance(trial.simulated)

    def result(self, best: BehaviorTree, stopped: str) -> Result:
        seconds = self.recorder.seconds
        references = self.setup.domain.references
        self.watcher.phase("validating", self.spec.validation * (1 + bool(references)))
        validator = Validator(self.setup.domain, self.spec.seed, self.watcher.advance, self.simulator)
        score = self.validated(validator, "best", best)
        named, ratio, complete = None, None, None
        if references:
            other = self.validated(validator, references[0].name, parse(references[0].tree))
            named = Named(references[0].name, other.mean, other.stderr)
            ratio = score.mean / other.mean if other.mean else None
            complete = self.complete(best)
        tree, episodes = format_tree(best), self.evaluator.episodes
        self.recorder.event(event="finished", tree=tree, trials=self.tally.trials, episodes=episodes, complete=complete)
        return Result(
            str(self.folder.path), tree, score.mean, score.stderr, episodes, self.tally.trials, seconds,
            named, ratio, complete, stopped, self.spec.validation, self.tally.bad,
        )  # fmt: skip

    def validated(self, validator: Validator, name: str, tree: BehaviorTree) -> Score:
        score = validator.score(tree, self.spec.validation)
        self.recorder.event(event="validation", name=name, tree=format_tree(tree), **asdict(score))
        return score

    def complete(self, best: BehaviorTree) -> bool | None:
        self.watcher.phase("ablating", 0)
        validator = Validator(self.setup.domain, self.spec.seed, self.watcher.advance, self.simulator)
        return Ablator(validator, min(self.spec.validation, _ABLATION_EPISODES)).ablate(best).complete
