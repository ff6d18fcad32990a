"""A run from beginning to end: search, select, validate."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, cast

from attrs import asdict, frozen

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
    """What `grammarbt run --json` prints; the fields are those of the documented JSON."""

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


def execute(setup: Setup, watcher: Watcher) -> Result:
    """Make the run's folder and run.

    Raises:
        GrammarBTError: the folder cannot be used, the searcher broke, or every trial failed.
        KeyboardInterrupt: the user stopped it; the journal is whole up to the last batch, and the best tree saved.
    """
    folder = create_folder(setup.spec, setup.resolved)
    return go_on(setup, folder, Journal.open(folder.journal), Replay(), watcher)


def go_on(setup: Setup, folder: RunFolder, journal: Journal, replay: Replay, watcher: Watcher) -> Result:
    """Run in a folder, from where its journal ends; closes the journal.

    Raises:
        RunError: what is in the journal does not happen again.
        GrammarBTError: as `execute`.
        KeyboardInterrupt: as `execute`.
    """
    watcher.folder(folder.path)
    with Recorder(folder, journal) as recorder, setup.executor:
        return _Run(setup, folder, recorder, replay, watcher).run()


class _Run:
    def __init__(self, setup: Setup, folder: RunFolder, recorder: Recorder, replay: Replay, watcher: Watcher) -> None:
        self.setup, self.spec = setup, setup.spec
        self.folder, self.recorder, self.watcher = folder, recorder, watcher
        self.simulator = make_simulator(setup.domain, setup.executor, self.spec.workers)
        self.evaluator = Evaluator(setup.domain, self.spec.seed, replay, self.simulator)
        self.loop = AskTellLoop(setup.searcher, self.evaluator, self.spec, self.record_batch)

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
        self.watcher.phase("searching", self.spec.search_episodes)
        try:
            reason = self.loop.run()
        finally:
            if self.loop.incumbent.tree is not None:
                self.folder.save_best(self.loop.incumbent.tree)
        self.recorder.event(event="searched", stopped=reason, trials=self.loop.trials, episodes=self.evaluator.episodes)
        return reason

    def record_batch(self, trials: Sequence[Trial]) -> None:
        self.recorder.batch(trials)
        first = self.loop.trials - len(trials) + 1
        for number, trial in enumerate(trials, first):
            self.watcher.advance(trial.simulated)
            self.watcher.notify(self.trial_finished(number, trial))

    def trial_finished(self, number: int, trial: Trial) -> TrialFinished:
        evaluation, incumbent = trial.evaluation, self.loop.incumbent
        return TrialFinished(
            self.folder.path,
            number,
            self.evaluator.episodes,
            format_tree(evaluation.proposal.tree),
            evaluation.status,
            evaluation.mean,
            incumbent.mean,
            "" if incumbent.tree is None else format_tree(incumbent.tree),
            guarded("metrics", self.setup.searcher.metrics),
        )

    def select(self) -> BehaviorTree:
        if self.loop.incumbent.tree is None:
            raise RunError("no tree could be evaluated", f"the errors stand in {self.folder.journal}")
        self.watcher.phase("selecting", self.spec.selection_episodes)
        candidates = guarded("candidates", lambda: self.setup.searcher.candidates(MAX_CANDIDATES))
        if not isinstance(cast("object", candidates), Sequence) or len(candidates) > MAX_CANDIDATES:
            raise SearcherError("candidates must return a list of trees, no more than asked for", "best first")
        halving = SuccessiveHalving(self.evaluator, self.record_selection)
        return halving.best(candidates or [self.loop.incumbent.tree], self.spec.selection_episodes)

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
        self.recorder.event(event="finished", tree=tree, trials=self.loop.trials, episodes=episodes, complete=complete)
        return Result(
            str(self.folder.path), tree, score.mean, score.stderr, episodes, self.loop.trials, seconds,
            named, ratio, complete, stopped, self.spec.validation,
        )  # fmt: skip

    def validated(self, validator: Validator, name: str, tree: BehaviorTree) -> Score:
        score = validator.score(tree, self.spec.validation)
        self.recorder.event(event="validation", name=name, tree=format_tree(tree), **asdict(score))
        return score

    def complete(self, best: BehaviorTree) -> bool | None:
        self.watcher.phase("ablating", 0)
        validator = Validator(self.setup.domain, self.spec.seed, self.watcher.advance, self.simulator)
        return Ablator(validator, min(self.spec.validation, _ABLATION_EPISODES)).ablate(best).complete
